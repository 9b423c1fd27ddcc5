// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_clip.hpp"
