// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geomap/map_edit_record_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "mapping/edit.hpp"
#include "mapping/view_feature.hpp"

namespace geomap::mapping {

/// @brief A map that is being looked at and edited: a running mapper's, or one in a file.
class EditSession {
 public:
  virtual ~EditSession() = default;
  /// @throws std::runtime_error when the map cannot be had. So do the others.
  virtual std::map<FeatureId, ViewFeature> features() = 0;
  /// @brief All edits, ascending by number.
  virtual std::vector<geomap::map_edit_record_t> history() = 0;
  /// @brief Asks for an edit and waits for the answer.
  virtual geomap::map_edit_reply_t edit(const EditCommand& command, bool is_dry_run) = 0;
};

/// @brief Edits a saved map. @param out where it is saved after each edit.
std::unique_ptr<EditSession> edit_file(const std::filesystem::path& map,
                                       const std::filesystem::path& out);

/// @brief Edits the map of a running mapper. What is lost on the way is sent again.
/// @param patience for an answer [s]
std::unique_ptr<EditSession> edit_live(const std::string& url, const std::string& channel_prefix,
                                       double patience);

}  // namespace geomap::mapping
