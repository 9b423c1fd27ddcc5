// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/logged_edits.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace geomap::mapping {
namespace {

EditCommand command(const std::string& author, std::int64_t number) {
  return {.author = author, .command = number};
}

TEST(LoggedEdits, WaitForTheirReplyAndForTheirPlaceInTheOrderOfTheReplies) {
  LoggedEdits edits;
  edits.add(command("ann", 1), 0);
  edits.add(command("bob", 1), 0);
  edits.add(command("ann", 2), 0);
  EXPECT_FALSE(edits.next(1000));
  edits.take_reply("bob", 1, true, 500);
  edits.take_reply("ann", 1, true, 700);
  edits.take_reply("ann", 2, false, 700);  // was refused
  edits.take_reply("eve", 9, true, 100);   // of a command that is not in the log
  EXPECT_FALSE(edits.next(499));
  const auto first = edits.next(600);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->command.author, "bob");
  EXPECT_EQ(first->after, 500);
  EXPECT_FALSE(edits.next(600));
  EXPECT_EQ(edits.next(700)->command.author, "ann");
  EXPECT_FALSE(edits.next_at_end());
}

TEST(LoggedEdits, WithoutAReplyTheyHaveTheirPlaceBehindWhatTheirAuthorHadSeen) {
  LoggedEdits edits;
  edits.add(command("ann", 1), 300);
  edits.add(command("ann", 2), 0);
  edits.add(command("ann", 1), 300);  // sent again
  edits.add(command("ann", 3), 0);
  edits.take_reply("ann", 3, true, 900);
  EXPECT_EQ(edits.next_at_end()->after, 900);
  EXPECT_EQ(edits.next_at_end()->after, 300);
  EXPECT_EQ(edits.next_at_end()->after, std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(edits.next_at_end());
}

}  // namespace
}  // namespace geomap::mapping
