// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_hash.hpp"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <stdexcept>

namespace geomap::mapping {
namespace {

// Canonical bytes of a map, most significant byte first, fed to SHA-256.
class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("SHA-256 is not available");
    }
  }

  void add(std::int64_t value) {
    std::array<unsigned char, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<unsigned char>(static_cast<std::uint64_t>(value) >> (56 - 8 * i));
    }
    EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
  }
  void add(double value) { add(std::bit_cast<std::int64_t>(value == 0.0 ? 0.0 : value)); }
  void add(const Eigen::Vector3d& v) {
    for (const double x : v) add(x);
  }
  void add(const std::string& text) {
    add(static_cast<std::int64_t>(text.size()));
    EVP_DigestUpdate(context_.get(), text.data(), text.size());
  }
  void add(const ObservationId& id) {
    add(id.keyframe);
    add(static_cast<std::int64_t>(id.plane));
  }
  void add(const geometry::Ring& ring) {
    add(static_cast<std::int64_t>(ring.size()));
    for (const geometry::GridPoint p : ring) {
      add(static_cast<std::int64_t>(p.x));
      add(static_cast<std::int64_t>(p.y));
    }
  }

  std::string hex() {
    std::array<unsigned char, 32> bytes{};
    EVP_DigestFinal_ex(context_.get(), bytes.data(), nullptr);
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : bytes) {
      text += kDigits[byte >> 4];
      text += kDigits[byte & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

void add(Digest& digest, const MapFeature& feature) {
  digest.add(feature.id);
  digest.add(feature.surface.plane.normal);
  digest.add(feature.surface.plane.d);
  digest.add(feature.surface.frame.origin);
  digest.add(feature.surface.frame.x_axis);
  digest.add(feature.surface.frame.normal);
  for (const double value : feature.moments.to_array()) digest.add(value);
  digest.add(static_cast<std::int64_t>(feature.surface.polygon.parts.size()));
  for (const geometry::PolygonPart& part : feature.surface.polygon.parts) {
    digest.add(part.outer);
    digest.add(static_cast<std::int64_t>(part.holes.size()));
    for (const geometry::Ring& hole : part.holes) digest.add(hole);
  }
  digest.add(static_cast<std::int64_t>(feature.observations.size()));
  for (const ObservationId& id : feature.observations) digest.add(id);
  digest.add(feature.inliers);
  for (const double channel : feature.color) digest.add(channel);
  digest.add(feature.label);
}

}  // namespace

std::string map_hash(const FeatureSet& features) {
  Digest digest;
  for (const auto& [id, feature] : features) add(digest, *feature);
  return digest.hex();
}

}  // namespace geomap::mapping
