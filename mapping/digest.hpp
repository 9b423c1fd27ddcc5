// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>

#include "geometry/polygon.hpp"
#include "mapping/map_feature.hpp"

struct evp_md_ctx_st;

namespace geomap::mapping {

/// @brief SHA-256 over canonical bytes: every number as 8 bytes, most significant first; every text
/// and list after its length.
class Digest {
 public:
  Digest();

  template <std::integral Integer>
  void add(Integer value) {
    add_number(static_cast<std::int64_t>(value));
  }
  void add(double value);  // -0 counts as 0
  void add(const Eigen::Vector3d& v);
  void add(const std::string& text);
  void add(const ObservationId& id);
  void add(const geometry::Polygon& polygon);

  /// @brief In hexadecimal; to be called once, at the end.
  std::string hex();

 private:
  void add_number(std::int64_t value);

  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

}  // namespace geomap::mapping
