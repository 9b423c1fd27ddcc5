// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mapping/feature_filter.hpp"
#include "viewer/panels.hpp"
#include "viewer/text_field.hpp"

namespace geomap::viewer {
namespace {

enum Column { kNumber, kLabel, kArea, kHeight, kSeen, kColumns };

struct Row {
  const mapping::ViewFeature* feature;
  const Surface* surface;
};

bool contains(const std::string& text, const std::string& part) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

// A search is a condition as geomap-edit knows them, or a part of the label, id or number.
// @throws std::invalid_argument with what is wrong with a condition.
std::function<bool(const Row&)> make_filter(const std::string& search) {
  if (search.find_first_of("<>=") != std::string::npos) {
    return
        [filter = mapping::parse_filter(search)](const Row& row) { return filter(*row.feature); };
  }
  return [search](const Row& row) {
    return contains(row.feature->label, search) ||
           contains(mapping::to_string(row.feature->id), search) ||
           std::to_string(row.surface->number) == search;
  };
}

bool is_before(const Row& a, const Row& b, Column column) {
  switch (column) {
    case kLabel:
      return a.feature->label < b.feature->label;
    case kArea:
      return a.surface->area < b.surface->area;
    case kHeight:
      return a.surface->centroid.z() < b.surface->centroid.z();
    case kSeen:
      return a.feature->observations < b.feature->observations;
    default:
      return a.surface->number < b.surface->number;
  }
}

std::vector<Row> make_rows(const App& app, const std::function<bool(const Row&)>& is_wanted) {
  std::vector<Row> rows;
  for (const auto& [id, feature] : app.workbench.scene().map.features) {
    const Surface* surface = app.workbench.surfaces().find(id);
    if (!surface) continue;
    const Row row{&feature, surface};
    if (is_wanted(row)) rows.push_back(row);
  }
  const ImGuiTableSortSpecs* sort = ImGui::TableGetSortSpecs();
  if (sort && sort->SpecsCount > 0) {
    const auto column = static_cast<Column>(sort->Specs->ColumnIndex);
    const bool is_falling = sort->Specs->SortDirection == ImGuiSortDirection_Descending;
    std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
      return is_falling ? is_before(b, a, column) : is_before(a, b, column);
    });
  }
  return rows;
}

void draw_row(App& app, const Row& row) {
  const mapping::FeatureId id = row.feature->id;
  const bool is_selected = app.workbench.selected().contains(id);
  ImGui::TableNextRow();
  ImGui::TableSetColumnIndex(kNumber);
  const std::string name = fmt::format("{}##row", row.surface->number);
  ImGui::PushID(mapping::to_string(id).c_str());
  if (ImGui::Selectable(
          name.c_str(), is_selected,
          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
    if (ImGui::IsMouseDoubleClicked(0)) {
      app.view.fly_to(row.surface->box);
    } else if (ImGui::GetIO().KeyCtrl) {
      app.workbench.toggle(id);
    } else {
      app.workbench.select({id});
    }
  }
  if (ImGui::IsItemHovered()) app.workbench.hover(id);
  ImGui::PopID();
  ImGui::TableSetColumnIndex(kLabel);
  ImGui::Text("%s%s", row.feature->locked ? "* " : "", row.feature->label.c_str());
  ImGui::TableSetColumnIndex(kArea);
  ImGui::Text("%.2f", row.surface->area);
  ImGui::TableSetColumnIndex(kHeight);
  ImGui::Text("%.2f", row.surface->centroid.z());
  ImGui::TableSetColumnIndex(kSeen);
  ImGui::Text("%d", row.feature->observations);
}

}  // namespace

void draw_feature_list(App& app, float height) {
  ImGui::SetNextItemWidth(-1.0F);
  text_field("##search", "search: label, number, area>0.5 ...", app.search);
  std::function<bool(const Row&)> is_wanted;
  try {
    is_wanted = make_filter(app.search);
  } catch (const std::invalid_argument& error) {
    ImGui::TextWrapped("%s", error.what());
    is_wanted = [](const Row&) { return true; };
  }
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("features", kColumns, kFlags, {0.0F, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("#", ImGuiTableColumnFlags_DefaultSort, 0.7F);
  ImGui::TableSetupColumn("label", 0, 1.2F);
  ImGui::TableSetupColumn("m2", ImGuiTableColumnFlags_PreferSortDescending, 1.0F);
  ImGui::TableSetupColumn("height", 0, 1.35F);
  ImGui::TableSetupColumn("seen", ImGuiTableColumnFlags_PreferSortDescending, 1.0F);
  ImGui::TableHeadersRow();
  const std::vector<Row> rows = make_rows(app, is_wanted);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      draw_row(app, rows[static_cast<std::size_t>(i)]);
    }
  }
  ImGui::EndTable();
  if (rows.empty() && !app.search.empty()) ImGui::TextDisabled("nothing matches");
}

}  // namespace geomap::viewer
