// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geomap/keyframe_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief Says of a key frame, in plain words, whether it was registered and why not. Three
/// rejected in a row are called lost.
Taken note_registration(const geomap::keyframe_t& message, RegistrationState& state);

}  // namespace geomap::viewer
