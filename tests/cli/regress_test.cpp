// `drude regress` from outside: what it notices, what it says, what it writes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "image/image.h"
#include "program.h"

namespace drude {
namespace {

std::string scene_of(double n) {
    return "LookAt 0 0 -4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 20\n"
           "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
           "PixelFilter \"box\"\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
           "Material \"conductor\" \"spectrum eta\" [ 300 " +
           std::to_string(n) + " 800 " + std::to_string(n) +
           " ] \"spectrum k\" [ 300 2.59 800 2.59 ]\nShape \"sphere\"\n";
}

nlohmann::json one_case(const std::string& name) {
    return {{"name", name},
            {"scene", name + ".pbrt"},
            {"purpose", "a test of <" + name + ">"},
            {"samples", 64},
            {"seed", 1},
            {"reference_samples", 256},
            {"reference_seed", 2},
            {"largest_bias", 0.01}};
}

void write_manifest_of(const TemporaryFolder& folder, const nlohmann::json& cases) {
    const nlohmann::json manifest = {
        {"format", "drude-references/1"}, {"alpha", 1e-5}, {"cases", cases}};
    write_text(folder.file("manifest.json"), manifest.dump(2));
}

// A folder with one case whose reference is up to date.
void prepare(const TemporaryFolder& folder) {
    write_text(folder.file("metal.pbrt"), scene_of(1.04));
    write_manifest_of(folder, nlohmann::json::array({one_case("metal")}));
    const ProgramRun run = run_drude(folder, "regress . -q --update --why 'first pictures'");
    ASSERT_EQ(run.status, 0) << run.out << run.err;
}

TEST(Regress, AnUpdatedReferencePassesAndItsReasonIsKept) {
    const TemporaryFolder folder;
    prepare(folder);
    const auto manifest = nlohmann::json::parse(read_text(folder.file("manifest.json")));
    const auto& history = manifest["cases"][0]["history"];
    ASSERT_EQ(history.size(), 1u);
    EXPECT_EQ(history[0]["why"], "first pictures");
    EXPECT_EQ(history[0]["date"].get<std::string>().size(), 10u);
    // S0..S3 with variances, and nothing twice.
    const Image reference = read_exr(folder.file("metal.exr"));
    EXPECT_EQ(reference.channels.size(), 24u);
    EXPECT_EQ(reference.find("R"), nullptr);
    EXPECT_EQ(reference.text("commandLine"),
              "drude render metal.pbrt --stokes --spp 256 --seed 2 -o metal.exr");

    const ProgramRun run = run_drude(folder, "regress . --json");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["passed"], 1);
    EXPECT_EQ(json["failed"], 0);
    const auto& result = json["cases"][0];
    EXPECT_EQ(result["status"], "passed");
    EXPECT_GT(result["p_min"], 1e-5);
    EXPECT_LT(result["detectable_bias"], 0.01);
    EXPECT_FALSE(result["scene_changed"]);
    const ProgramRun threads = run_drude(folder, "regress . --json --threads 1");
    EXPECT_EQ(nlohmann::json::parse(threads.out)["cases"][0]["p_min"], result["p_min"]);
    // Passing references stay as they are.
    const std::string before = read_text(folder.file("metal.exr"));
    ASSERT_EQ(run_drude(folder, "regress . -q --update --why again").status, 0);
    EXPECT_EQ(read_text(folder.file("metal.exr")), before);
    ASSERT_EQ(run_drude(folder, "regress . -q --update --all --why again").status, 0);
    EXPECT_NE(read_text(folder.file("manifest.json")).find("\"again\""), std::string::npos);
}

TEST(Regress, AnotherMetalFailsAndEveryReportSaysSo) {
    const TemporaryFolder folder;
    prepare(folder);
    write_text(folder.file("metal.pbrt"), scene_of(1.3));
    const ProgramRun run =
        run_drude(folder, "regress . -q --json --html page.html --junit junit.xml");
    ASSERT_EQ(run.status, 1) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["failed"], 1);
    const auto& result = json["cases"][0];
    EXPECT_EQ(result["status"], "failed");
    EXPECT_LT(result["p_min"], 1e-20);
    EXPECT_TRUE(result["scene_changed"]);
    EXPECT_EQ(result["means"].size(), 12u);

    const std::string page = read_text(folder.file("page.html"));
    EXPECT_NE(page.find("Not passed"), std::string::npos);
    EXPECT_LT(page.find("metal: failed"), page.find("<h2>All cases"));
    EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
    EXPECT_NE(page.find("class=\"swap\""), std::string::npos);
    EXPECT_NE(page.find("a test of &lt;metal&gt;"), std::string::npos);
    EXPECT_EQ(page.find("http:"), std::string::npos);
    EXPECT_EQ(page.find("https:"), std::string::npos);

    const std::string junit = read_text(folder.file("junit.xml"));
    EXPECT_NE(junit.find("tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\""),
              std::string::npos)
        << junit;
    EXPECT_NE(junit.find("<failure type=\"failed\""), std::string::npos) << junit;
}

// The commands of the report do what they say.
TEST(Regress, CommandsOfAFailureRenderCompareAndUpdate) {
    const TemporaryFolder folder;
    prepare(folder);
    write_text(folder.file("metal.pbrt"), scene_of(1.3));
    const auto json = nlohmann::json::parse(run_drude(folder, "regress . -q --json").out);
    const auto& commands = json["cases"][0]["commands"];
    const auto run = [&](const std::string& key) {
        return run_drude(folder, commands[key].get<std::string>().substr(6) + " -q");
    };
    ASSERT_EQ(run("render").status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder.file("metal-new.exr")));
    // Another scene than the reference's is an error of `compare` unless it is said to be meant.
    EXPECT_EQ(run("compare").status, 1);
    EXPECT_EQ(run("update").status, 0);
    EXPECT_EQ(run("compare").status, 0);
}

TEST(Regress, UpdateWantsAReason) {
    const TemporaryFolder folder;
    prepare(folder);
    for (const char* arguments : {"regress . --update", "regress . --update --why ' '"}) {
        const ProgramRun run = run_drude(folder, arguments);
        EXPECT_EQ(run.status, 2);
        EXPECT_NE(run.err.find("--why"), std::string::npos) << run.err;
    }
    EXPECT_EQ(run_drude(folder, "regress . --why x").status, 2);
    EXPECT_EQ(run_drude(folder, "regress . --update --seed 5 --why x").status, 2);
}

TEST(Regress, NoiseThatHidesTheBiasIsNoPass) {
    const TemporaryFolder folder;
    prepare(folder);
    auto weak = one_case("metal");
    weak["largest_bias"] = 1e-9;
    write_manifest_of(folder, nlohmann::json::array({weak}));
    const ProgramRun run = run_drude(folder, "regress . -q");
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.out.find("take more samples"), std::string::npos) << run.out;
}

TEST(Regress, ACaseWithoutReferenceAndABadSceneAreToldApart) {
    const TemporaryFolder folder;
    prepare(folder);
    write_text(folder.file("bad.pbrt"), "WorldBegin\nShap \"sphere\"\n");
    write_text(folder.file("new.pbrt"), scene_of(2));
    write_manifest_of(folder,
                      nlohmann::json::array({one_case("metal"), one_case("bad"), one_case("new")}));
    const ProgramRun run = run_drude(folder, "regress . -q --json --junit j.xml --html p.html");
    EXPECT_EQ(run.status, 2) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["cases"][0]["status"], "passed");
    EXPECT_EQ(json["cases"][1]["status"], "error");
    EXPECT_NE(json["cases"][1]["message"].get<std::string>().find("bad.pbrt:2"), std::string::npos);
    EXPECT_EQ(json["cases"][2]["status"], "missing");
    EXPECT_NE(read_text(folder.file("j.xml")).find("<error type=\"error\" message="),
              std::string::npos);
    // The picture of the case without reference is on the page.
    EXPECT_NE(read_text(folder.file("p.html")).find("alt=\"new, new picture\""), std::string::npos);
    // One broken scene does not keep the others from their references.
    const ProgramRun update = run_drude(folder, "regress . -q --update --all --why more");
    EXPECT_EQ(update.status, 2);
    EXPECT_NE(update.err.find("bad: not updated: "), std::string::npos) << update.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("new.exr")));
    const ProgramRun some = run_drude(folder, "regress . -q --only 'm*'");
    EXPECT_EQ(some.status, 0) << some.out;
    // The same picture of another file is a pass that is told.
    write_text(folder.file("metal.pbrt"), "# another line\n" + scene_of(1.04));
    const ProgramRun changed = run_drude(folder, "regress . -q --only metal");
    EXPECT_EQ(changed.status, 0) << changed.out;
    EXPECT_NE(changed.out.find("metal: passed, but the scene"), std::string::npos) << changed.out;
}

TEST(Regress, BadManifestsAndNamesAreErrorsWithTheirPlace) {
    const TemporaryFolder folder;
    prepare(folder);
    const auto error_of = [&](const std::string& key, const nlohmann::json& value) {
        auto one = one_case("metal");
        one[key] = value;
        write_manifest_of(folder, nlohmann::json::array({one}));
        const ProgramRun run = run_drude(folder, "regress .");
        EXPECT_EQ(run.status, 2) << key << run.out;
        EXPECT_NE(run.err.find("manifest.json:"), std::string::npos) << run.err;
        return run.err;
    };
    EXPECT_NE(error_of("sampels", 3).find("did you mean 'samples'"), std::string::npos);
    EXPECT_NE(error_of("seed", 2).find("independent"), std::string::npos);
    EXPECT_NE(error_of("samples", 1.5).find("whole number"), std::string::npos);
    EXPECT_NE(error_of("samples", 31).find("from 32 to"), std::string::npos);
    EXPECT_NE(error_of("reference_samples", 16).find("from 32 to"), std::string::npos);
    EXPECT_NE(error_of("name", "../x").find("file's name"), std::string::npos);
    EXPECT_NE(error_of("largest_bias", 0).find("more than 0"), std::string::npos);
    write_manifest_of(folder, nlohmann::json::array({one_case("metal"), one_case("metal")}));
    EXPECT_NE(run_drude(folder, "regress .").err.find("used twice"), std::string::npos);
    write_manifest_of(folder, nlohmann::json::array());
    EXPECT_NE(run_drude(folder, "regress .").err.find("at least one"), std::string::npos);
    write_manifest_of(folder, nlohmann::json::array({one_case("metal")}));
    const ProgramRun only = run_drude(folder, "regress . --only meta");
    EXPECT_EQ(only.status, 2);
    EXPECT_NE(only.err.find("did you mean 'metal'"), std::string::npos) << only.err;
    EXPECT_EQ(run_drude(folder, "regress . --seed 2").status, 2);
    EXPECT_EQ(run_drude(folder, "regress nowhere").status, 2);
}

// A reference that the run would agree with whatever the scene looks like.
TEST(Regress, AReferenceOfTheRunsOwnSeedIsNoReference) {
    const TemporaryFolder folder;
    prepare(folder);
    ASSERT_EQ(
        run_drude(folder, "render metal.pbrt --stokes --spp 256 --seed 1 -q -o metal.exr").status,
        0);
    const ProgramRun same = run_drude(folder, "regress . -q");
    EXPECT_EQ(same.status, 2) << same.out;
    EXPECT_NE(same.out.find("was rendered with seed 1; the manifest says 2"), std::string::npos)
        << same.out;
    ASSERT_EQ(
        run_drude(folder, "render metal.pbrt --stokes --spp 64 --seed 2 -q -o metal.exr").status,
        0);
    const ProgramRun few = run_drude(folder, "regress . -q");
    EXPECT_EQ(few.status, 2) << few.out;
    EXPECT_NE(few.out.find("64 samples a pixel; the manifest says 256"), std::string::npos)
        << few.out;
    EXPECT_EQ(run_drude(folder, "regress . -q --update --why 'as declared'").status, 0);
}

TEST(Regress, ABlackPictureIsNoPass) {
    const TemporaryFolder folder;
    std::string dark = scene_of(1.04);
    const size_t light = dark.find("LightSource");
    dark.erase(light, dark.find("Material") - light);
    write_text(folder.file("metal.pbrt"), dark);
    write_manifest_of(folder, nlohmann::json::array({one_case("metal")}));
    const ProgramRun run = run_drude(folder, "regress . -q --json --update --why dark");
    EXPECT_EQ(run.status, 1) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["cases"][0]["status"], "weak");
    EXPECT_TRUE(json["cases"][0]["detectable_bias"].is_null());
    EXPECT_NE(json["cases"][0]["message"].get<std::string>().find("S0 is 0 everywhere"),
              std::string::npos);
}

TEST(Regress, AReferenceOfAnotherSizeIsTheCasesError) {
    const TemporaryFolder folder;
    prepare(folder);
    auto small = one_case("metal");
    small["resolution"] = "4x4";
    write_manifest_of(folder, nlohmann::json::array({small}));
    const ProgramRun run = run_drude(folder, "regress . -q --html page.html");
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_NE(run.out.find("expected pictures of one size"), std::string::npos) << run.out;
    EXPECT_EQ(run_drude(folder, "regress . -q --update --why smaller").status, 0);
}

// References that another program wrote, or a broken disk.
TEST(Regress, AReferenceThatCannotBeComparedIsTheCasesError) {
    const TemporaryFolder folder;
    prepare(folder);
    write_text(folder.file("metal.exr"), "no picture");
    const ProgramRun run = run_drude(folder, "regress . -q");
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.out.find("OpenEXR"), std::string::npos) << run.out;
}

}  // namespace
}  // namespace drude
