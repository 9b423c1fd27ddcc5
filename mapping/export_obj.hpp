// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// @brief Contents of an OBJ file and of the material library beside it.
struct ObjFiles {
  std::string obj;
  std::string mtl;
};

/// @brief The map as one named object and one material per feature; world frame (z up), metres, six
/// decimals. An object is named "ID" or "ID_label", with underscores for blanks.
/// @param mtl_name the material library's file name, as the OBJ file refers to it.
ObjFiles to_obj(const MapSnapshot& map, const std::string& mtl_name);

}  // namespace geomap::mapping
