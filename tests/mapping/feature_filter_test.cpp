// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/feature_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace geomap::mapping {
namespace {

using ::testing::HasSubstr;

// A level square of 2 m at a height of 0.75 m.
ViewFeature table(std::int64_t keyframe, std::int32_t plane) {
  ViewFeature feature;
  feature.id = {keyframe, plane};
  feature.origin = {0, 0, 7500};
  feature.normal = {0, 0, 1'000'000};
  feature.x_axis = {30'000, 0, 0};
  feature.polygon.parts = {{geometry::rectangle({-1, -1}, {1, 1}), {}}};
  feature.observations = 12;
  feature.rms = 35;
  feature.label = "table";
  return feature;
}

TEST(FeatureFilter, ConditionsLookAtEveryField) {
  const ViewFeature feature = table(1, 0);
  for (const char* text :
       {"area>3.9", "area<=4.001", "height>=0.75", "height=0.75", "slope=1", "observations=12",
        "observations!=11", "rms<0.004", "held=0", "label=table", "label!=wall",
        " area > 0.5 and label = table and held=0 "}) {
    EXPECT_TRUE(parse_filter(text)(feature)) << text;
  }
  for (const char* text : {"area>4.1", "height<0", "held=1", "label=wall", "label=table and area<1",
                           "area<1 and label=table"}) {
    EXPECT_FALSE(parse_filter(text)(feature)) << text;
  }
}

TEST(FeatureFilter, WhatIsNoConditionIsSaid) {
  const auto message = [](const char* text) -> std::string {
    try {
      parse_filter(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(""), HasSubstr("no condition"));
  EXPECT_THAT(message("area"), HasSubstr("no condition"));
  EXPECT_THAT(message("size>1"), HasSubstr("no field"));
  EXPECT_THAT(message("area>big"), HasSubstr("no number"));
  EXPECT_THAT(message("area=>1"), HasSubstr("no relation"));
  EXPECT_THAT(message("area>1 and "), HasSubstr("no condition"));
}

TEST(FindFeature, ByNumberIdOrEndOfTheId) {
  std::map<FeatureId, ViewFeature> features;
  for (const FeatureId id : {FeatureId{1000, 2}, FeatureId{1000, 12}, FeatureId{2000, 2}}) {
    features.emplace(id, table(id.keyframe, id.plane));
  }
  EXPECT_EQ(find_feature("1", features), (FeatureId{1000, 2}));
  EXPECT_EQ(find_feature("#3", features), (FeatureId{2000, 2}));
  EXPECT_EQ(find_feature("1000-12", features), (FeatureId{1000, 12}));
  EXPECT_EQ(find_feature("-12", features), (FeatureId{1000, 12}));
  EXPECT_EQ(find_feature("2000-2", features), (FeatureId{2000, 2}));
  for (const char* name : {"0", "4", "-2", "7-7", "", "#", "x", "-1"}) {
    EXPECT_THROW(find_feature(name, features), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace geomap::mapping
