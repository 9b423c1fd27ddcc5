// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/triangulate.hpp"
