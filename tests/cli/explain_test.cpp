// --explain from outside: what is said for people and for scripts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace drude {
namespace {

using nlohmann::json;

const char* const scene =
    "LookAt 0 -5 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 40\n"
    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
    "Integrator \"path\" \"integer maxdepth\" 6\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
    "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" \"float beta\" "
    "0.2\nShape \"sphere\"\n";

json decision_on(const json& document, const std::string& name) {
    for (const json& decision : document.at("decisions")) {
        if (decision.at("name") == name) return decision;
    }
    ADD_FAILURE() << "no decision on " << name;
    return {};
}

void expect_complete(const json& decisions) {
    for (const json& decision : decisions) {
        for (const char* key : {"name", "choice", "reason", "override"}) {
            EXPECT_FALSE(decision.at(key).get<std::string>().empty()) << decision;
        }
        EXPECT_TRUE(decision.at("asked").is_boolean());
        for (const char* key : {"cost", "error"}) {
            const json& figure = decision.at(key);
            EXPECT_TRUE(figure.at("value").is_number() || figure.at("value").is_null()) << decision;
            EXPECT_FALSE(figure.at("basis").get<std::string>().empty()) << decision;
        }
        for (const json& other : decision.at("alternatives")) {
            EXPECT_FALSE(other.at("choice").get<std::string>().empty()) << decision;
        }
    }
}

TEST(Explain, ADryRunSaysWhatARenderWouldDo) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    const ProgramRun people = run_drude(folder, "render s.pbrt --dry-run --explain");
    EXPECT_EQ(people.status, 0) << people.err;
    for (const char* part : {"transport: scalar", "bounces: 1", "light sampling: none",
                             "override  --transport", "film or bare metal: bare metal"}) {
        EXPECT_NE(people.out.find(part), std::string::npos) << part << "\n" << people.out;
    }
    const ProgramRun scripts = run_drude(folder, "render s.pbrt --dry-run --explain --json");
    ASSERT_EQ(scripts.status, 0) << scripts.err;
    const json dry = json::parse(scripts.out);
    EXPECT_EQ(dry.at("decisions").size(), 8u);
    expect_complete(dry.at("decisions"));
    const ProgramRun rendered =
        run_drude(folder, "render s.pbrt --spp 16 --explain --json -o s.exr");
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    const json wet = json::parse(rendered.out);
    EXPECT_EQ(decision_on(wet, "transport").at("choice"), wet.at("transport"));
    EXPECT_EQ(decision_on(wet, "bounces"), decision_on(dry, "bounces"));
    // Without the option nothing is said.
    EXPECT_FALSE(
        json::parse(run_drude(folder, "render s.pbrt --dry-run --json").out).contains("decisions"));
}

TEST(Explain, OverridesAreOptions) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    const ProgramRun run =
        run_drude(folder,
                  "render s.pbrt --dry-run --explain --json --transport stokes --wavelengths 40 "
                  "--mirror-below 0.5 --films leave-out --sample-every-light --every-ray");
    ASSERT_EQ(run.status, 0) << run.err;
    const json document = json::parse(run.out);
    for (const char* name : {"transport", "wavelengths a path", "light sampling", "mirror or lobe",
                             "film or bare metal"}) {
        EXPECT_EQ(decision_on(document, name).at("asked"), true) << name;
    }
    EXPECT_EQ(decision_on(document, "mirror or lobe").at("choice"), "1 replaced by a mirror");
    const ProgramRun wrong = run_drude(folder, "render s.pbrt -o s.exr --mirror-below -1");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("expected a number from 0"), std::string::npos) << wrong.err;
}

TEST(Explain, SurfacesModelledOtherwiseDoNotMerge) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    EXPECT_EQ(run_drude(folder, "render s.pbrt --spp 32 --shard 0/2 -o a.exr").status, 0);
    EXPECT_EQ(
        run_drude(folder, "render s.pbrt --spp 32 --shard 1/2 --mirror-below 0.5 -o b.exr").status,
        0);
    EXPECT_EQ(run_drude(folder, "render s.pbrt --spp 32 --shard 1/2 --every-ray -o c.exr").status,
              0);
    EXPECT_EQ(run_drude(folder, "merge a.exr b.exr -o m.exr").status, 2);
    EXPECT_EQ(run_drude(folder, "merge a.exr c.exr -o m.exr").status, 0);
}

TEST(Explain, AFitSaysWhichAnglesItNeeds) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_drude(folder,
                        "simulate Cu-McPeak --angles 45,60,75 --wavelengths 400:700:50 "
                        "--seed 3 -o m.csv")
                  .status,
              0);
    const ProgramRun run = run_drude(folder, "fit m.csv --explain --json");
    ASSERT_EQ(run.status, 0) << run.err;
    const json document = json::parse(run.out);
    EXPECT_EQ(document.at("decisions").size(), 7u);
    expect_complete(document.at("decisions"));
    EXPECT_EQ(decision_on(document, "angles").at("choice"), "all 3: 45, 60, 75 degrees");
    const ProgramRun people = run_drude(folder, "fit m.csv --explain");
    EXPECT_NE(people.out.find("override  --angles LIST"), std::string::npos) << people.out;
    const json fewer =
        json::parse(run_drude(folder,
                              "fit m.csv --angles 60,75 --dispersion auto --robust auto "
                              "--json")
                        .out);
    EXPECT_EQ(fewer.at("angles_deg"), json::parse("[60.0, 75.0]"));
    EXPECT_EQ(fewer.at("ladder").size(), 2u);
    const ProgramRun wrong = run_drude(folder, "fit m.csv --angles 61");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("45, 60, 75"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace drude
