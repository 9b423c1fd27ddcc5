// SPDX-License-Identifier: BSD-3-Clause
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <utility>

#include "polygon_unions.hpp"

namespace geomap::bench {
namespace {

using Point = boost::geometry::model::d2::point_xy<double>;
// Counter-clockwise and open, as ours are.
using Part = boost::geometry::model::polygon<Point, false, false>;
using Parts = boost::geometry::model::multi_polygon<Part>;

void append(const geometry::Ring& ring, Part::ring_type& converted) {
  for (const geometry::GridPoint p : ring) converted.emplace_back(p.x, p.y);
}

Parts converted(const geometry::Polygon& polygon) {
  Parts parts;
  for (const geometry::PolygonPart& part : polygon.parts) {
    Part& copy = parts.emplace_back();
    append(part.outer, copy.outer());
    for (const geometry::Ring& hole : part.holes) append(hole, copy.inners().emplace_back());
  }
  return parts;
}

}  // namespace

Union boost_union(const geometry::Polygon& a, const geometry::Polygon& b) {
  return [a = converted(a), b = converted(b)] {
    Parts both;
    boost::geometry::union_(a, b, both);
    return both.size();
  };
}

}  // namespace geomap::bench
