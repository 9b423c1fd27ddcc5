// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace geomap::drivers {

/// @brief Random numbers that are the same bits on every machine and with every library: only
/// integers and operations that IEEE 754 rounds exactly (+, -, *, /, square root).
///
/// SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
/// Seeds that follow each other give streams without anything in common.
class PortableRandom {
 public:
  explicit PortableRandom(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// @brief Uniform in [0, 1): the upper 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// @brief Standard normal, by the inverse of its distribution function; within 8.3.
  double normal();

 private:
  std::uint64_t state_;
};

/// @brief Where the standard normal distribution function reaches `p`, 0 < p < 1, to about 16
/// digits. PPND16 of Wichura, "Algorithm AS 241: The Percentage Points of the Normal Distribution",
/// Applied Statistics 37 (1988).
double normal_quantile(double p);

}  // namespace geomap::drivers
