// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/message_schema.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace geomap::messaging {
namespace {

TEST(MessageSchema, ReadsConstantsCommentsListsAndArrays) {
  const SchemaRegistry registry(R"(
    package a; /* over
    lines */
    struct outer_t {
      const int8_t ONE = 1, TWO = 2;  // no part of the layout
      int32_t n, m;
      inner_t inners[n];
      double x[3], y;
      string name;
    }
    struct inner_t { byte b; int64_t t; }
  )");
  const MessageSchema& outer = registry.all().at("a.outer_t");
  ASSERT_EQ(outer.fields.size(), 6U);
  EXPECT_EQ(outer.fields[2].nested, &registry.all().at("a.inner_t"));
  EXPECT_EQ(outer.fields[2].array->count_field, 0U);
  EXPECT_EQ(outer.fields[3].array->length, 3U);
  EXPECT_EQ(registry.all().at("a.inner_t").smallest_size, 9U);
  EXPECT_EQ(outer.smallest_size, 4U + 4U + 0U + 24U + 8U + 5U);
}

TEST(MessageSchema, FindsTypesByTheirFingerprint) {
  const SchemaRegistry registry("package a; struct b_t { int8_t x; } struct c_t { int16_t x; }");
  for (const auto& [name, schema] : registry.all()) {
    ASSERT_NE(registry.find(schema.fingerprint), nullptr);
    EXPECT_EQ(registry.find(schema.fingerprint)->name, name);
  }
  EXPECT_EQ(registry.find(0), nullptr);
}

TEST(MessageSchema, RefusesWhatItDoesNotUnderstand) {
  for (const char* text : {
           "struct",                                                  // ends too early
           "struct a_t { int8_t }",                                   // no name
           "struct a_t { nobody_t x; }",                              // unknown type
           "struct a_t { double x[n]; }",                             // nothing counts
           "struct a_t { double n; double x[n]; }",                   // counted by a double
           "struct a_t { int8_t x[2][2]; }",                          // two dimensions
           "package p; struct a_t { a_t x; }",                        // part of itself
           "package p; struct a_t { b_t x; } struct b_t { a_t x; }",  // and by a detour
           "package p; struct a_t { } struct a_t { }",                // twice
           "/* for ever",
       }) {
    EXPECT_THROW(SchemaRegistry{text}, std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace geomap::messaging
