// SPDX-License-Identifier: BSD-3-Clause
// Prints the digest of the extraction that this program is built with, see CMakeLists.txt.
#include <iostream>

#include "perception/extraction_digest.hpp"

int main() {
  for (const std::string& line : geomap::testing::extraction_digest()) std::cout << line << "\n";
}
