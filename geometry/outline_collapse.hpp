// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief Rings that shrink edge by edge, the smallest error first, none ever touching itself or
/// another: the work behind `simplify`. Lengths in grid units.
class OutlineCollapse {
 public:
  OutlineCollapse(std::vector<Ring> rings, double tolerance,
                  const std::function<bool(GridPoint)>& is_fixed);

  /// @brief Collapses what the tolerance allows.
  void run();

  /// @brief The rings as they are now, in the order given.
  std::vector<Ring> rings() const;

 private:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  // A vertex; dead ones stay in the list. The originals between the anchors of two neighbours are
  // those that the edge between them stands for.
  struct Node {
    GridPoint point;
    Index prev, next, ring;
    Index anchor;  // index of an original vertex of the ring
    bool fixed, alive;
  };

  // Replaces the vertices between `from` and `to` (one or two) by `middle`, or by nothing.
  struct Step {
    Index from = kNone, to = kNone;
    std::optional<GridPoint> middle;
    double squared_error = 0.0;
  };

  // A step's outline: `swept` runs along the old path and back along the new one.
  struct Change {
    Ring new_path, swept;
    GridPoint lower, upper;  // box of `swept`
  };

  std::optional<Step> step_at(Index first) const;
  Step collapse(Index b, Index c) const;
  Step removal(Index b) const;
  void refresh(Index first);
  void forget(Index first);
  bool within_tolerance(const Step& step) const;
  bool keeps_topology(const Step& step) const;
  bool obstructs(Index p, const Step& step, const Change& change) const;
  Index vertices_after(const Step& step) const;
  Index nearest_original(const Step& step) const;
  void apply(const Step& step);

  std::vector<Ring> originals_;
  std::vector<Index> counts_;  // living vertices of each ring
  std::vector<Node> nodes_;
  std::vector<std::optional<Step>> steps_;  // best known step for the edge that starts at a node
  std::vector<double> errors_;              // of those steps, kept dense for the search
  std::vector<Index> listed_;  // the living vertices, and dead ones since the list was last renewed
  std::size_t steps_since_listing_ = 0;
  double squared_tolerance_;
};

}  // namespace geomap::geometry
