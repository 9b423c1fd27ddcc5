// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "viewer/render_polygons.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

constexpr std::array<const char*, 4> kLabelNames = {"none", "number", "label", "id"};

// The number of a word; `otherwise` where it is none of them.
template <std::size_t size>
int number_of(const std::string& word, const std::array<const char*, size>& words, int otherwise) {
  const auto* at = std::find(words.begin(), words.end(), word);
  return at == words.end() ? otherwise : static_cast<int>(at - words.begin());
}

}  // namespace

bool RenderPolygons::panel() {
  int chosen_color = static_cast<int>(color), chosen_label = static_cast<int>(label);
  bool is_changed = choice("Colour", chosen_color, kPolygonColorNames);
  is_changed |= choice("Label", chosen_label, kLabelNames);
  is_changed |= slider("Opacity", opacity, 0.0, 1.0, "%.2f");
  color = static_cast<PolygonColor>(chosen_color);
  label = static_cast<Label>(chosen_label);
  return is_changed;
}

void RenderPolygons::load(const Preferences& preferences) {
  const std::string color_word = preferences.get(name() + ".color", std::string());
  const std::string label_word = preferences.get(name() + ".label", std::string());
  color =
      static_cast<PolygonColor>(number_of(color_word, kPolygonColorNames, static_cast<int>(color)));
  label = static_cast<Label>(number_of(label_word, kLabelNames, static_cast<int>(label)));
  opacity = std::clamp(preferences.get(name() + ".opacity", opacity), 0.0, 1.0);
}

void RenderPolygons::store(Preferences& preferences) const {
  preferences.set(name() + ".color",
                  std::string(kPolygonColorNames[static_cast<std::size_t>(color)]));
  preferences.set(name() + ".label", std::string(kLabelNames[static_cast<std::size_t>(label)]));
  preferences.set(name() + ".opacity", opacity);
}

}  // namespace geomap::viewer
