// SPDX-License-Identifier: BSD-3-Clause
// Loops are compiled for several processors (geometry/multiversion.hpp); what is made of
// a frame must not depend on which of them one happens to have.
#include <cstdlib>
#include <sstream>

#include "messaging/temporary_folder.hpp"
#include "perception/perception_digest.hpp"

namespace geomap::perception {
namespace {

class VectorVersions : public testing::TemporaryFolder {
 protected:
  // What the program prints whose loops are compiled for one instruction set, line by line.
  std::vector<std::string> digest_of(const std::string& level) const {
    const std::string command = GEOMAP_PERCEPTION_DIGEST "_" + level + " >" + path("digest");
    if (std::system(command.c_str()) != 0) return {};
    std::istringstream text(read_file(path("digest")));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(VectorVersions, TheBaselineGivesTheSameBytes) {
  EXPECT_EQ(digest_of("x86-64"), testing::perception_digest());
}

TEST_F(VectorVersions, Avx2GivesTheSameBytes) {
  if (!__builtin_cpu_supports("x86-64-v3")) GTEST_SKIP() << "this processor has no AVX2";
  EXPECT_EQ(digest_of("x86-64-v3"), testing::perception_digest());
}

TEST_F(VectorVersions, Avx512GivesTheSameBytes) {
  if (!__builtin_cpu_supports("x86-64-v4")) GTEST_SKIP() << "this processor has no AVX-512";
  EXPECT_EQ(digest_of("x86-64-v4"), testing::perception_digest());
}

}  // namespace
}  // namespace geomap::perception
