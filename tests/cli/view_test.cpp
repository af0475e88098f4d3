// `drude view` from outside: its pictures, its figures, its errors.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "image/image.h"
#include "program.h"

namespace drude {
namespace {

// Left half horizontally polarised by 0.5, right half fully circularly; the last pixel is black.
Image picture(bool spectral) {
    Image image;
    image.width = 40;
    image.height = 30;
    std::vector<std::string> suffixes = {"R", "G", "B"};
    if (spectral) suffixes = {"R", "G", "B", "500,000000nm", "600,000000nm"};
    for (const std::string& suffix : suffixes) {
        for (int i = 0; i < 4; ++i) image.add("S" + std::to_string(i) + "." + suffix);
        for (size_t p = 0; p + 1 < image.pixels(); ++p) {
            const bool left = p % 40 < 20;
            image.find("S0." + suffix)->data[p] = 2.0F;
            image.find("S1." + suffix)->data[p] = left ? 1.0F : 0.0F;
            image.find("S3." + suffix)->data[p] = left ? 0.0F : 2.0F;
        }
    }
    return image;
}

TEST(ViewCommand, EveryFigureBecomesAPictureWithItsScale) {
    const TemporaryFolder folder;
    write_exr(folder.file("a.exr"), picture(true), Compression::zip);
    for (const char* show : {"dop", "dolp", "docp", "aolp", "s0", "s1", "s2", "s3"}) {
        const ProgramRun run =
            run_drude(folder, std::string("view a.exr -o a.png --json --show ") + show);
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_GT(read_image(folder.file("a.png")).width, 52) << show;
        const auto json = nlohmann::json::parse(run.out);
        EXPECT_EQ(json["layer"], "Y");
        EXPECT_TRUE(json["wavelength_nm"].is_null());
        const bool component = show[0] == 's';
        EXPECT_EQ(json["pixels_without_value"] == 0, component) << show;
        EXPECT_EQ(json["mean"].is_null(), show == std::string("aolp"));
        EXPECT_EQ(json["low"] < 0.0, component && show[1] != '0');
    }
    const ProgramRun run =
        run_drude(folder, "view a.exr -o a.png --show dolp --wavelength 560 --json");
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["wavelength_nm"], 600.0);
    // 600 pixels of 0.5 and 599 of 0, all as bright.
    EXPECT_NEAR(json["mean"].get<double>(), 0.5 * 600 / 1199, 1e-12);
    EXPECT_EQ(json["pixels_without_value"], 1);
    const ProgramRun said = run_drude(folder, "view a.exr -o a.png --show dolp --wavelength 560");
    EXPECT_NE(said.out.find("600 nm, the layer nearest to 560 nm"), std::string::npos) << said.out;
}

TEST(ViewCommand, AnalysersWorkOnTheFinishedPicture) {
    const TemporaryFolder folder;
    write_exr(folder.file("a.exr"), picture(true), Compression::zip);
    const auto passed = [&](const std::string& arguments) {
        const ProgramRun run = run_drude(folder, "view " + arguments + " --json");
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out)["passed"].get<double>();
    };
    EXPECT_NEAR(passed("a.exr --show analyser=0 -o h.exr"), (600 * 0.75 + 599 * 0.5) / 1199, 1e-6);
    EXPECT_NEAR(passed("a.exr --show analyser=0,retarder=-45 -o c.png"),
                (600 * 0.5 + 599 * 1.0) / 1199, 1e-6);
    EXPECT_NEAR(passed("h.exr --show analyser=90 -o dark.png"), 0.0, 1e-6);
    const Image behind = read_image(folder.file("h.exr"));
    EXPECT_EQ(behind.at("R", "h.exr").data[0], 1.5F);
    EXPECT_EQ(behind.at("S0.500,000000nm", "h.exr").data[39], 1.0F);
    // The circular light passes whole and is as bright as without the filter; half of the other.
    const Image shown = read_image(folder.file("c.png"));
    EXPECT_EQ(shown.width, 40);
    EXPECT_NEAR(shown.at("G", "c.png").data[38], 1.0F, 0.02F);
    EXPECT_NEAR(shown.at("G", "c.png").data[2], 0.5F, 0.02F);
    const Image dark = read_image(folder.file("dark.png"));
    for (const float value : dark.at("G", "dark.png").data) EXPECT_LT(value, 1e-3F);
    passed("a.exr --show analyser=0 --wavelength 510 -o one.png");
}

TEST(ViewCommand, ErrorsSayWhatToDo) {
    const TemporaryFolder folder;
    write_exr(folder.file("a.exr"), picture(false), Compression::zip);
    Image plain;
    plain.width = plain.height = 4;
    for (const char* name : {"R", "G", "B"}) plain.add(name);
    write_exr(folder.file("plain.exr"), plain, Compression::zip);
    const auto error_of = [&](const std::string& arguments) {
        const ProgramRun run = run_drude(folder, "view " + arguments);
        EXPECT_EQ(run.status, 2) << arguments << run.out;
        EXPECT_EQ(run.out, "");
        return run.err;
    };
    const auto says = [](const std::string& text, const char* part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    says(error_of("plain.exr --show dop -o a.png"), "render the scene with --stokes");
    says(error_of("a.exr --show dop -o a.png --wavelength 550"), "--spectral");
    says(error_of("a.exr --show dlop -o a.png"), "did you mean 'dolp'");
    says(error_of("a.exr --show analizer=3 -o a.png"), "did you mean 'analyser'");
    says(error_of("a.exr --show analyser -o a.png"), "analyser=45");
    says(error_of("a.exr --show dolp=3 -o a.png"), "expected dop");
    says(error_of("a.exr -o a.png"), "--show");
    says(error_of("a.exr --show dop"), "-o OUT.png");
    says(error_of("a.exr --show dop -o a.exr"), ".png");
    says(error_of("a.exr --show dop -o a.jpg"), ".png");
    says(error_of("a.exr --show aolp -o a.png --range 3"), "leave it out");
    says(error_of("a.exr --show s1 -o a.png --range -3"), "above 0");
    says(error_of("a.exr --show s1 -o a.png --wavelength -3"), "above 0");
    says(error_of("none.exr --show s1 -o a.png"), "none.exr");
}

}  // namespace
}  // namespace drude
