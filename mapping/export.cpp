// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mapping/export_file.hpp"
#include "mapping/export_glb.hpp"
#include "mapping/export_json.hpp"
#include "mapping/export_obj.hpp"
#include "mapping/export_ply.hpp"

namespace geomap::mapping {
namespace {

using Writer = void (*)(const MapSnapshot&, const std::filesystem::path&, const ExportOptions&);

void write_ply(const MapSnapshot& map, const std::filesystem::path& out,
               const ExportOptions& options) {
  const PlyFormat format = options.ascii ? PlyFormat::kAscii : PlyFormat::kBinaryLittleEndian;
  write_file(out, to_ply(map, format));
}

void write_obj(const MapSnapshot& map, const std::filesystem::path& out, const ExportOptions&) {
  std::filesystem::path mtl = out;
  mtl.replace_extension(".mtl");
  const ObjFiles files = to_obj(map, mtl.filename().string());
  write_file(mtl, files.mtl);
  write_file(out, files.obj);
}

void write_glb(const MapSnapshot& map, const std::filesystem::path& out, const ExportOptions&) {
  write_file(out, to_glb(map));
}

void write_svg(const MapSnapshot& map, const std::filesystem::path& out,
               const ExportOptions& options) {
  write_file(out, to_svg(map, options.svg));
}

void write_json(const MapSnapshot& map, const std::filesystem::path& out, const ExportOptions&) {
  write_file(out, to_map_json(map));
}

struct Format {
  std::string_view extension;
  Writer write;
};

constexpr std::array<Format, 5> kFormats = {{{".ply", write_ply},
                                             {".obj", write_obj},
                                             {".glb", write_glb},
                                             {".svg", write_svg},
                                             {".json", write_json}}};

const Format& format_of(const std::filesystem::path& out) {
  std::string extension = out.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const Format& format : kFormats) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  throw std::invalid_argument(out.string() + ": cannot export to '" + extension +
                              "'; known extensions: " + known);
}

}  // namespace

void check_extension(const std::filesystem::path& out) { format_of(out); }

void export_map(const MapSnapshot& map, const std::filesystem::path& out,
                const ExportOptions& options) {
  format_of(out).write(map, out, options);
}

}  // namespace geomap::mapping
