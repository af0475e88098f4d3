// What the program says to input that is wrong: where, what was found, what was expected; the exit
// status of the contract; and nothing half-written left behind.
#include <gtest/gtest.h>

#include "program.h"

namespace drude {
namespace {

// A message for people: no type names, no stack, one program name at its head.
void expect_message(const ProgramRun& run, int status, std::initializer_list<const char*> parts) {
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.err.rfind("drude: ", 0), 0u) << run.err;
    for (const char* part : parts) EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    for (const char* leak : {"std::", "what()", "terminate", "nlohmann", "internal error"}) {
        EXPECT_EQ(run.err.find(leak), std::string::npos) << run.err;
    }
}

size_t files_in(const TemporaryFolder& folder) {
    size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        count += name != ".out" && name != ".err";
    }
    return count;
}

constexpr const char* scene =
    "LookAt 0 0 -4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 32\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
    "Material \"conductor\" \"string material\" \"Cu\" \"float beta\" 0 \"string lobe\" "
    "\"beckmann\"\nShape \"sphere\"\n";

TEST(BadInput, MissingFiles) {
    const TemporaryFolder folder;
    expect_message(run_drude(folder, "render none.pbrt -o a.exr"), 2,
                   {"none.pbrt", "No such file"});
    expect_message(run_drude(folder, "fit none.csv -o a.json"), 2, {"none.csv"});
    expect_message(run_drude(folder, "compare a.exr b.exr"), 2, {"a.exr"});
    expect_message(run_drude(folder, "eval none.json --angle 45 --wavelength 550"), 2,
                   {"none.json"});
    expect_message(run_drude(folder, "reproduce -o s --environment none.exr"), 2, {"none.exr"});
}

TEST(BadInput, UnknownWords) {
    const TemporaryFolder folder;
    expect_message(run_drude(folder, "rendr"), 2, {"rendr", "'render'"});
    expect_message(run_drude(folder, "eval Cv --angle 45 --wavelength 550"), 2, {"Cv", "Cu"});
    expect_message(run_drude(folder, "eval Cu --angel 45 --wavelength 550"), 2,
                   {"--angel", "--angle"});
    expect_message(run_drude(folder, "eval Cu --angle fifty --wavelength 550"), 2,
                   {"--angle", "fifty"});
}

TEST(BadInput, MalformedScenes) {
    const TemporaryFolder folder;
    const std::string text = scene;
    write_text(folder.file("word.pbrt"), text + "Shap \"sphere\"\n");
    expect_message(run_drude(folder, "render word.pbrt -o a.exr"), 2,
                   {"word.pbrt:8:1", "Shap", "'Shape'"});
    write_text(folder.file("open.pbrt"), text + "Shape \"sphere");
    expect_message(run_drude(folder, "render open.pbrt -o a.exr"), 2, {"open.pbrt:8:"});
    write_text(folder.file("type.pbrt"), text + "Shape \"sphere\" \"float radius\" \"wide\"\n");
    expect_message(run_drude(folder, "render type.pbrt -o a.exr"), 2, {"type.pbrt:8:"});
    write_text(folder.file("binary.pbrt"), std::string("\x7f"
                                                       "ELF\0\1\2\xff",
                                                       8));
    expect_message(run_drude(folder, "render binary.pbrt -o a.exr"), 2, {"binary.pbrt"});
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.exr")));
}

TEST(BadInput, MeasurementsThatHoldNoNumbers) {
    const TemporaryFolder folder;
    const std::string head = "wavelength_nm,angle_deg,psi_deg,delta_deg\n550,60,38,120\n";
    write_text(folder.file("nan.csv"), head + "555,60,nan,120\n");
    expect_message(run_drude(folder, "fit nan.csv -o a.json"), 2, {"nan.csv:3:", "nan"});
    write_text(folder.file("twice.csv"), head + "550,60,38,120\n");
    expect_message(run_drude(folder, "fit twice.csv -o a.json"), 2, {"twice.csv:3"});
    write_text(folder.file("range.csv"), head + "550,95,38,120\n");
    expect_message(run_drude(folder, "fit range.csv -o a.json"), 2, {"range.csv:3"});
    write_text(folder.file("empty.csv"), "wavelength_nm,angle_deg,psi_deg,delta_deg\n");
    expect_message(run_drude(folder, "fit empty.csv -o a.json"), 2, {"empty.csv"});
    write_text(folder.file("nothing.csv"), "");
    expect_message(run_drude(folder, "fit nothing.csv -o a.json"), 2, {"nothing.csv"});
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.json")));
}

TEST(BadInput, EmptyRanges) {
    const TemporaryFolder folder;
    expect_message(run_drude(folder, "simulate Cu --angles 60 --wavelengths 700:400:5 -o m.csv"), 2,
                   {"700", "400"});
    expect_message(run_drude(folder, "simulate Cu --angles 60 --wavelengths 400:700:0 -o m.csv"), 2,
                   {"step"});
    expect_message(run_drude(folder, "simulate Cu --angles 95 --wavelengths 400:700:5 -o m.csv"), 2,
                   {"95"});
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(BadInput, APictureOfTheWrongShapeIsNoEnvironment) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    ASSERT_EQ(run_drude(folder, "render s.pbrt --spp 1 --resolution 30x20 -q -o a.exr").status, 0);
    expect_message(run_drude(folder, "render s.pbrt --environment a.exr -q -o b.exr"), 2,
                   {"a.exr", "30 x 20", "twice as wide"});
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.exr")));
}

TEST(BadInput, AFullDiskLeavesWhatWasThere) {
    const TemporaryFolder folder;
    write_text(folder.file("s.pbrt"), scene);
    ASSERT_EQ(run_drude(folder, "render s.pbrt --spp 2 -q -o a.exr").status, 0);
    const std::string before = read_text(folder.file("a.exr"));
    ASSERT_GT(before.size(), 16000u);
    const size_t files = files_in(folder);
    expect_message(run_drude(folder, "render s.pbrt --spp 2 --seed 5 -q -o a.exr", "ulimit -f 8; "),
                   3, {"a.exr"});
    EXPECT_EQ(read_text(folder.file("a.exr")), before);
    expect_message(
        run_drude(folder, "simulate Cu --angles 45:80:1 --wavelengths 380:780:1 -o m.csv",
                  "ulimit -f 8; "),
        3, {"m.csv"});
    EXPECT_EQ(files_in(folder), files);
}

}  // namespace
}  // namespace drude
