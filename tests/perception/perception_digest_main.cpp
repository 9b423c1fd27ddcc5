// SPDX-License-Identifier: BSD-3-Clause
// Prints the digest of the vector loops that this program is built with, see CMakeLists.txt.
#include <iostream>

#include "perception/perception_digest.hpp"

int main() {
  for (const std::string& line : geomap::testing::perception_digest()) std::cout << line << "\n";
}
