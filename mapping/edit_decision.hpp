// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "mapping/edit.hpp"
#include "mapping/event_history.hpp"
#include "mapping/map_contents.hpp"

namespace geomap::mapping {

/// @brief What a command comes to.
struct EditDecision {
  std::shared_ptr<const Edit> edit;  // what to apply; null: nothing
  std::string refusal;               // why not, in words
};

/// @brief Turns what an operator asks for into an edit of this map, or says why it cannot be: a
/// feature that is gone or part of another one now, an edit that is undone already, nothing to
/// undo.
/// @param features of the map at the place of the edit, `after`.
EditDecision decide(const EditCommand& command, std::int64_t after, const FeatureSet& features,
                    const EventHistory& history);

}  // namespace geomap::mapping
