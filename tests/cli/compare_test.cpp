// `drude compare` from outside: its errors, its pictures, its figures.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "image/image.h"
#include "program.h"

namespace drude {
namespace {

// A grey picture of width x height with variances, as of a renderer.
Image picture(int width, int height, float value) {
    Image image;
    image.width = width;
    image.height = height;
    for (const char* name : {"R", "G", "B"}) {
        for (float& x : image.add(name).data) x = value;
        for (float& x : image.add(std::string("variance.") + name).data) x = 1e-4F;
    }
    image.attributes["batches"] = 16;
    return image;
}

void write(const TemporaryFolder& folder, const std::string& name, const Image& image) {
    write_exr(folder.file(name), image, Compression::zip);
}

TEST(CompareCommand, WhatCannotBeComparedHasItsOwnError) {
    const TemporaryFolder folder;
    Image image = picture(16, 8, 0.5F);
    write(folder, "a.exr", image);
    write(folder, "size.exr", picture(8, 16, 0.5F));
    image.attributes["sceneHash"] = std::string("0123456789abcdef");
    write(folder, "scene.exr", image);
    image.attributes["sceneHash"] = std::string("fedcba9876543210");
    write(folder, "other.exr", image);
    image.channels.erase(image.channels.begin());
    write(folder, "channel.exr", image);
    const auto error_of = [&](const std::string& arguments) {
        const ProgramRun run = run_drude(folder, "compare " + arguments);
        EXPECT_EQ(run.status, 2) << run.out;
        return run.err;
    };
    EXPECT_NE(error_of("a.exr size.exr").find("16 x 8"), std::string::npos);
    EXPECT_NE(error_of("scene.exr other.exr").find("different scenes"), std::string::npos);
    EXPECT_NE(error_of("a.exr channel.exr").find("no channel 'R'"), std::string::npos);
    EXPECT_EQ(run_drude(folder, "compare scene.exr other.exr --any-scene").status, 0);
    error_of("a.exr a.exr --z-map");
    error_of("a.exr a.exr --z-map --log -o d.png");
    error_of("a.exr a.exr --pair p.exr");
    EXPECT_NE(error_of("a.exr a.exr --flip hdp").find("did you mean 'hdr'"), std::string::npos);
}

TEST(CompareCommand, PicturesOfTheDifference) {
    const TemporaryFolder folder;
    write(folder, "a.exr", picture(40, 20, 0.5F));
    write(folder, "b.exr", picture(40, 20, 0.53F));
    const ProgramRun run =
        run_drude(folder, "compare a.exr b.exr --z-map -o z.png --pair pair.png --flip hdr --json");
    ASSERT_EQ(run.status, 1) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_GT(json["flip"]["mean"], 0.0);
    EXPECT_EQ(json["flip"]["kind"], "hdr");
    EXPECT_EQ(json["worst"]["test"], "mean");
    EXPECT_LT(json["worst"]["z"], -10.0);
    // 0.03 over the root of 2e-4 is 2.1 standard errors: pale blue, the same everywhere.
    const Image z = read_image(folder.file("z.png"));
    const Image pair = read_image(folder.file("pair.png"));
    EXPECT_GT(z.width, 40);
    EXPECT_GE(pair.width, 80);
    const auto blueness = [&](const Image& image, int x, int y) {
        const size_t i =
            static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x);
        return image.find("B")->data[i] - image.find("R")->data[i];
    };
    EXPECT_GT(blueness(z, 16, 16), 0.05F);
    EXPECT_EQ(blueness(z, 16, 16), blueness(z, 30, 20));
}

TEST(CompareCommand, ResultsDoNotReplaceWhatIsCompared) {
    const TemporaryFolder folder;
    Image image;
    image.width = image.height = 2;
    for (const char* name : {"B", "G", "R"}) image.add(name);
    write_exr(folder.file("a.exr"), image, Compression::zip);
    const std::string before = read_text(folder.file("a.exr"));
    for (const char* output :
         {"-o a.exr", "-o ./a.exr", "-o d.png --pair ./d.png", "-o ../\"${PWD##*/}\"/a.exr"}) {
        const ProgramRun run = run_drude(folder, std::string("compare a.exr a.exr ") + output);
        EXPECT_EQ(run.status, 2) << output << run.out;
        EXPECT_NE(run.err.find("name "), std::string::npos) << run.err;
    }
    EXPECT_EQ(read_text(folder.file("a.exr")), before);
    EXPECT_EQ(run_drude(folder, "compare a.exr a.exr -o d.exr").status, 0);
}

TEST(CompareCommand, JsonOfNamesThatAreNoUtf8) {
    const TemporaryFolder folder;
    Image image;
    image.width = image.height = 2;
    for (const char* name : {"B", "G", "R"}) image.add(name);
    write_exr(folder.file("a\xff.exr"), image, Compression::zip);
    const ProgramRun compare = run_drude(folder, "compare a\xff.exr a\xff.exr --json");
    EXPECT_EQ(compare.status, 0) << compare.err;
    EXPECT_TRUE(nlohmann::json::accept(compare.out)) << compare.out;
    const ProgramRun tonemap = run_drude(folder, "tonemap a\xff.exr -o b\xff.png --json");
    EXPECT_EQ(tonemap.status, 0) << tonemap.err;
    EXPECT_TRUE(nlohmann::json::accept(tonemap.out)) << tonemap.out;
}

}  // namespace
}  // namespace drude
