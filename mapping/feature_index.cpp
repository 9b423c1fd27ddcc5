// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/feature_index.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>

namespace geomap::mapping {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
struct Entry {
  Box box;
  FeatureId id;
};
struct BoxOf {
  using result_type = const Box&;
  result_type operator()(const Entry& entry) const { return entry.box; }
};
struct SameId {
  bool operator()(const Entry& a, const Entry& b) const { return a.id == b.id; }
};

Box to_box(const Eigen::AlignedBox3d& box) {
  return {Point(box.min().x(), box.min().y(), box.min().z()),
          Point(box.max().x(), box.max().y(), box.max().z())};
}

}  // namespace

struct FeatureIndex::Tree {
  bg::index::rtree<Entry, bg::index::quadratic<16>, BoxOf, SameId> entries;
};

FeatureIndex::FeatureIndex() : tree_(std::make_unique<Tree>()) {}
FeatureIndex::~FeatureIndex() = default;
FeatureIndex::FeatureIndex(FeatureIndex&&) noexcept = default;
FeatureIndex& FeatureIndex::operator=(FeatureIndex&&) noexcept = default;

void FeatureIndex::insert(const FeatureId& id, const Eigen::AlignedBox3d& box) {
  tree_->entries.insert(Entry{to_box(box), id});
}

void FeatureIndex::remove(const FeatureId& id, const Eigen::AlignedBox3d& box) {
  tree_->entries.remove(Entry{to_box(box), id});
}

std::vector<FeatureId> FeatureIndex::query(const Eigen::AlignedBox3d& box) const {
  std::vector<Entry> found;
  tree_->entries.query(bg::index::intersects(to_box(box)), std::back_inserter(found));
  std::vector<FeatureId> ids;
  ids.reserve(found.size());
  for (const Entry& entry : found) ids.push_back(entry.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace geomap::mapping
