// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/latency.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::messaging {
namespace {

constexpr double kShortest = 1e-6;  // [s]
constexpr double kGrowth = 1.05;

}  // namespace

void Latency::add(double seconds) {
  const double place = std::log(std::max(seconds, kShortest) / kShortest) / std::log(kGrowth);
  const auto last = static_cast<double>(counts_.size() - 1);
  ++counts_[static_cast<std::size_t>(std::min(std::floor(place), last))];
  ++count_;
  max_ = std::max(max_, seconds);
}

double Latency::quantile(double share) const {
  const double wanted = share * static_cast<double>(count_);
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    passed += counts_[i];
    if (counts_[i] > 0 && static_cast<double>(passed) >= wanted) {
      return std::min(max_, kShortest * std::pow(kGrowth, static_cast<double>(i + 1)));
    }
  }
  return max_;
}

}  // namespace geomap::messaging
