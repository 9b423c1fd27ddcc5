// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/text_file.hpp"

#include <fstream>
#include <system_error>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(part, path, error);
  if (!file || error) {
    std::filesystem::remove(part, error);
    throw SourceError(path.string() + ": cannot be written");
  }
}

}  // namespace geomap::drivers
