#include "base/error.h"

#include <gtest/gtest.h>

#include "base/expect_error.h"

namespace drude {
namespace {

TEST(Place, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ((Place{"a.csv", 3, 7}.str()), "a.csv:3:7");
    EXPECT_EQ((Place{"a.csv", 3, 0}.str()), "a.csv:3");
    EXPECT_EQ((Place{"a.csv", 0, 7}.str()), "a.csv");
}

TEST(Error, CarriesCauseAndPlace) {
    expect_error(Cause::user, {"found 3"}, [] { user_error("found {}", 3); });
    expect_error(Cause::outside, {"disk full"}, [] { outside_error("{} full", "disk"); });
    expect_error(Cause::user, {"m.csv:2:5: found 'x'"}, [] {
        user_error_at({"m.csv", 2, 5}, "found '{}'", "x");
    });
}

TEST(Error, CausesAreTheDocumentedExitStatuses) {
    EXPECT_EQ(static_cast<int>(Cause::answer_is_no), 1);
    EXPECT_EQ(static_cast<int>(Cause::user), 2);
    EXPECT_EQ(static_cast<int>(Cause::outside), 3);
}

TEST(NearestWord, FindsSlipsOfTheHand) {
    const std::vector<std::string> words = {"simulate", "render", "reproduce", "fit"};
    EXPECT_EQ(nearest_word("rendr", words), "render");    // one left out
    EXPECT_EQ(nearest_word("rendder", words), "render");  // one too many
    EXPECT_EQ(nearest_word("rendar", words), "render");   // another
    EXPECT_EQ(nearest_word("redner", words), "render");   // neighbours swapped
    EXPECT_EQ(nearest_word("RENDER", words), "render");   // letter case is free
    EXPECT_EQ(nearest_word("reporduce", words), "reproduce");
    EXPECT_EQ(nearest_word("fti", words), "fit");
}

TEST(NearestWord, DoesNotGuess) {
    const std::vector<std::string> words = {"simulate", "render", "fit"};
    EXPECT_EQ(nearest_word("photograph", words), "");
    EXPECT_EQ(nearest_word("xyz", words), "");
    EXPECT_EQ(nearest_word("render", {}), "");
    EXPECT_EQ(nearest_word(std::string(1000, 'r'), words), "");
    EXPECT_EQ(did_you_mean("photograph", words), "");
    EXPECT_EQ(did_you_mean("simulat", words), " (did you mean 'simulate'?)");
}

TEST(NearestWord, TakesTheNearestOfSeveral) {
    EXPECT_EQ(nearest_word("--angle", {"--angles", "--range", "--angle"}), "--angle");
}

}  // namespace
}  // namespace drude
