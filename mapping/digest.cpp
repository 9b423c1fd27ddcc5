// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace geomap::mapping {
namespace {

void add_ring(Digest& digest, const geometry::Ring& ring) {
  digest.add(ring.size());
  for (const geometry::GridPoint p : ring) {
    digest.add(p.x);
    digest.add(p.y);
  }
}

}  // namespace

void Digest::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Digest::Digest() : context_(EVP_MD_CTX_new()) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available");
  }
}

void Digest::add_number(std::int64_t value) {
  std::array<unsigned char, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<unsigned char>(static_cast<std::uint64_t>(value) >> (56 - 8 * i));
  }
  EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
}

void Digest::add(double value) {
  add_number(std::bit_cast<std::int64_t>(value == 0.0 ? 0.0 : value));
}

void Digest::add(const Eigen::Vector3d& v) {
  for (const double x : v) add(x);
}

void Digest::add(const std::string& text) {
  add(text.size());
  EVP_DigestUpdate(context_.get(), text.data(), text.size());
}

void Digest::add(const ObservationId& id) {
  add(id.keyframe);
  add(id.plane);
}

void Digest::add(const geometry::Polygon& polygon) {
  add(polygon.parts.size());
  for (const geometry::PolygonPart& part : polygon.parts) {
    add_ring(*this, part.outer);
    add(part.holes.size());
    for (const geometry::Ring& hole : part.holes) add_ring(*this, hole);
  }
}

std::string Digest::hex() {
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

}  // namespace geomap::mapping
