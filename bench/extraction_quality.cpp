// SPDX-License-Identifier: BSD-3-Clause
// How well each extractor's labels follow the recorded kitchen, and the time it takes.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kitchen_frames.hpp"
#include "label_sheet.hpp"
#include "messaging/program.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/ransac_extractor.hpp"
#include "segmentation_quality.hpp"
#include "statistics.hpp"

namespace {

using namespace geomap;
using geometry::ColorImage;
using geometry::RgbdFrame;

constexpr std::size_t kPictures = 8;  // frames on the contact sheet

struct Candidate {
  std::string name;
  std::unique_ptr<perception::PlaneExtractor> extractor;
  bench::SegmentationQuality sum = {};
  std::vector<double> cover = {}, planes = {}, time = {};  // per frame; time [ms]
};

std::vector<Candidate> candidates(const std::string& wanted, const messaging::Config& config) {
  std::vector<Candidate> all;
  all.push_back({"organized", std::make_unique<perception::OrganizedExtractor>(
                                  config.read<perception::OrganizedExtractorConfig>("organized"))});
  all.push_back({"ransac", std::make_unique<perception::RansacExtractor>(
                               config.read<perception::RansacExtractorConfig>("ransac"))});
  if (wanted != "all") std::erase_if(all, [&](auto& one) { return one.name != wanted; });
  if (all.empty()) throw messaging::ConfigError("no extractor '" + wanted + "'");
  return all;
}

// @return the labels.
std::vector<std::int16_t> run(Candidate& candidate, const RgbdFrame& frame) {
  perception::ExtractedPlanes found;
  candidate.time.push_back(bench::milliseconds([&] {
    found = candidate.extractor->extract(frame, static_cast<std::uint64_t>(frame.utime), {});
  }));
  const bench::SegmentationQuality quality = bench::measure_segmentation(frame, found.label);
  candidate.cover.push_back(quality.cover());
  candidate.planes.push_back(quality.planes);
  candidate.sum += quality;
  return std::move(found.label);
}

void print(const std::vector<Candidate>& all, std::size_t frames) {
  std::printf("%zu kitchen frames; labels of at least 1000 pixels; share of all readings\n\n",
              frames);
  std::printf(
      "| extractor | cover %%, median (p5) | mismatch %% | split (flush) | rms mm | planes, median "
      "| "
      "time ms, median (p95) |\n|---|--:|--:|--:|--:|--:|--:|\n");
  const auto per_frame = static_cast<double>(frames);
  for (const Candidate& one : all) {
    std::printf("| %s | %.1f (%.1f) | %.2f | %.2f (%.2f) | %.1f | %.0f | %.2f (%.2f) |\n",
                one.name.c_str(), 1e2 * bench::median(one.cover),
                1e2 * bench::quantile(one.cover, 0.05), 1e2 * one.sum.mismatch(),
                one.sum.splits / per_frame, one.sum.flush_splits / per_frame, 1e3 * one.sum.rms(),
                bench::median(one.planes), bench::median(one.time),
                bench::quantile(one.time, 0.95));
  }
  std::printf(
      "\n| cover %% by depth | <1 m | 1-1.5 | 1.5-2 | 2-2.5 | 2.5-3 | >3 m |\n"
      "|---|--:|--:|--:|--:|--:|--:|\n| share of the readings |");
  for (const bench::DepthBin& bin : all.front().sum.bins) {
    std::printf(" %.1f |", 1e2 * static_cast<double>(bin.valid) /
                               static_cast<double>(all.front().sum.valid()));
  }
  for (const Candidate& one : all) {
    std::printf("\n| %s |", one.name.c_str());
    for (const bench::DepthBin& bin : one.sum.bins) {
      std::printf(" %.1f |", bin.valid == 0 ? 0.0
                                            : 1e2 * static_cast<double>(bin.labelled) /
                                                  static_cast<double>(bin.valid));
    }
  }
  std::printf("\n\nblocks judged for mismatch, a frame:");
  for (const Candidate& one : all) {
    std::printf(" %s %.0f", one.name.c_str(), static_cast<double>(one.sum.blocks) / per_frame);
  }
  std::printf("\n");
}

// Extractors take turns on every frame, so that whatever else the machine does hits them alike.
void measure(std::vector<Candidate>& all, int step, const std::string& pictures) {
  const std::vector<RgbdFrame> frames = bench::load_kitchen_frames(step);
  if (frames.empty()) throw std::runtime_error("no recording 'redkitchen' under GEOMAP_DATA");
  const std::size_t picture_step = (frames.size() + kPictures - 1) / kPictures;
  std::vector<std::vector<ColorImage>> sheet;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool is_shown = !pictures.empty() && i % picture_step == 0;
    if (is_shown) sheet.push_back({bench::picture_of_depth(frames[i].depth)});
    for (Candidate& one : all) {
      const std::vector<std::int16_t> label = run(one, frames[i]);
      if (is_shown) sheet.back().push_back(bench::picture_of_labels(frames[i].depth, label));
    }
  }
  print(all, frames.size());
  if (pictures.empty()) return;
  std::filesystem::create_directories(pictures);
  const auto file = std::filesystem::path(pictures) / "labels.png";
  bench::write_contact_sheet(sheet, file);
  std::printf("%s: every %zuth frame from the first on; from left to right depth", file.c_str(),
              picture_step * static_cast<std::size_t>(step));
  for (const Candidate& one : all) std::printf(", %s", one.name.c_str());
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  int step = 5;
  std::string extractor = "all", pictures;
  return messaging::run_program(
      argc, argv,
      {.name = "extraction_quality",
       .description = "Quality of the planes' labels on the recorded kitchen (GEOMAP_DATA)."},
      [&](messaging::OptionParser& parser) {
        parser.option("--step", step, "frames from one to the next");
        parser.option("--extractor", extractor, "name, or all");
        parser.option("--pictures", pictures, "folder for a contact sheet; empty: none");
      },
      [&](const messaging::CommonOptions& common) {
        if (step < 1) throw messaging::ConfigError("--step must be at least 1");
        std::vector<Candidate> all = candidates(extractor, common.config);
        measure(all, step, pictures);
        return 0;
      });
}
