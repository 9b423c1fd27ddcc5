// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/camera_model.hpp"

#include <cmath>

namespace geomap::geometry {

bool CameraModel::valid() const {
  return width > 0 && height > 0 && fx > 0.0 && fy > 0.0 && std::isfinite(fx) &&
         std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy);
}

}  // namespace geomap::geometry
