// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_runs.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::write_run;

// The elements that are not closed, or closed out of order; empty for a well-formed page.
std::vector<std::string> wrong_tags(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return {"<"};
    const std::string tag = html.substr(at + 1, end - at - 1);
    if (tag.starts_with("!") || tag.ends_with("/")) continue;
    if (!tag.starts_with("/")) {
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
    } else if (!open.empty() && open.back() == tag.substr(1)) {
      open.pop_back();
    } else {
      return {tag};
    }
  }
  return open;
}

class PageHtml : public testing::RunsFolder {};

TEST_F(PageHtml, TheHtmlIsWellFormedAndNeedsNoOtherFile) {
  write_paper_sets();
  write_run(run("my <set>/ransac-moments/seed1"), 0.001);
  write();
  const std::string html = written("evaluation.html");
  EXPECT_THAT(wrong_tags(html), IsEmpty());
  EXPECT_THAT(html, HasSubstr("my &lt;set&gt;"));
  EXPECT_THAT(html, HasSubstr("<figure><svg "));
  EXPECT_THAT(html, Not(HasSubstr("<?xml")));
  for (const char* outside : {"<img", "<script", "src=", "href=", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
  EXPECT_THAT(html, HasSubstr("-walls\""));
  EXPECT_THAT(html, Not(HasSubstr(" id=\"walls\"")));  // two maps would have the same
  EXPECT_THAT(wrong_tags("<p><b>text</p></b>"), ElementsAre("/p"));
  EXPECT_THAT(wrong_tags("<p>"), ElementsAre("p"));
}

TEST_F(PageHtml, PicturesLieBesideTheMarkdownThatShowsThem) {
  write_paper_sets();
  write();
  const std::string text = written("evaluation.md");
  for (const char* name :
       {"growth_n0.svg", "growth_n02.svg", "reduction_n0.svg", "reduction_n02.svg",
        "noise_d_angle.svg", "noise_d_dist.svg", "map_n0.svg", "map_n02.svg"}) {
    const std::string file = std::string("pictures/") + name;
    EXPECT_TRUE(fs::exists(path("out/" + file))) << name;
    EXPECT_THAT(text, HasSubstr("](" + file + ")"));
  }
  EXPECT_EQ(written("pictures/map_n0.svg"), read_file(run("n0/ransac-moments/seed1/map.svg")));
}

TEST_F(PageHtml, TheGrowthPlotHasACurveForEachWayToMergeAndOneForWhatWasExtracted) {
  write_paper_sets();
  write();
  const std::string svg = written("pictures/growth_n0.svg");
  for (const char* name : {">extracted, ransac<", ">map, ransac-moments<", ">map, ransac-paper<"}) {
    EXPECT_THAT(svg, HasSubstr(name));
  }
  std::size_t curves = 0;
  for (std::size_t at = 0; (at = svg.find("<polyline", at)) != std::string::npos; ++at) ++curves;
  EXPECT_EQ(curves, 3U);
  EXPECT_THAT(written("pictures/reduction_n0.svg"), HasSubstr(">paper, at its end<"));
  EXPECT_THAT(written("pictures/noise_d_angle.svg"), HasSubstr(">0.05<"));
}

}  // namespace
}  // namespace geomap::logs
