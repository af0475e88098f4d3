// Runs of `drude render` that are cut into shards and processes, killed, interrupted and resumed:
// always the picture of one undisturbed run.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "base/files.h"
#include "image/image.h"
#include "program.h"

namespace drude {
namespace {

constexpr const char* scene =
    "LookAt 0 0 -4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 32\n"
    "Film \"rgb\" \"integer xresolution\" 72 \"integer yresolution\" 64\n"
    "PixelFilter \"box\"\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
    "LightSource \"distant\" \"point3 from\" [1 1 -2]\n"
    "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" "
    "\"float beta\" 0.3\nShape \"sphere\"\n";

class FilmCommand : public testing::Test {
  protected:
    FilmCommand() { write_text(folder_.file("s.pbrt"), scene); }

    ProgramRun run(const std::string& arguments, const std::string& before = "") const {
        return run_drude(folder_, arguments, before);
    }
    void expect_same(const std::string& a, const std::string& b) const {
        const ProgramRun compared = run("compare --exact " + a + " " + b);
        EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
    }
    bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_.file(name));
    }
    // What waits until a checkpoint of part.exr is written, another than lies there now.
    std::function<void()> next_checkpoint() const {
        const auto time = [path = folder_.file("part.checkpoint.exr")] {
            std::error_code missing;
            return std::filesystem::last_write_time(path, missing);
        };
        return
            [time, before = time()] { EXPECT_TRUE(wait_until([&] { return time() != before; })); };
    }
    double seconds_of(const std::string& arguments) const {
        const auto start = std::chrono::steady_clock::now();
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    TemporaryFolder folder_;
};

// Killed at random moments, again and again, until it gets through: reading the scene, rendering,
// while a checkpoint is written, while the picture is; the first time soon after a checkpoint, so
// that there is something to go on from however busy the machine is.
TEST_F(FilmCommand, KilledAtAnyMomentAndResumedIsTheUndisturbedPicture) {
    std::mt19937 generator(17);
    for (const std::string how : {"--spp 768 --stokes", "--error 0.004 --spectral"}) {
        SCOPED_TRACE(how);
        const double whole = seconds_of("render s.pbrt -q -o whole.exr " + how);
        std::uniform_real_distribution<double> moment(0.05, 0.6);
        std::vector<std::string> words = {"render", "s.pbrt",   "-q",           "-o",  "part.exr",
                                          "--json", "--resume", "--checkpoint", "0.04"};
        std::istringstream more(how);
        for (std::string word; more >> word;) words.push_back(word);
        ASSERT_EQ(run_and_signal(folder_, words, SIGKILL, next_checkpoint()), 128 + SIGKILL);
        int resumed = 0;
        for (int turn = 0;; ++turn) {
            ASSERT_LT(turn, 200) << "no run gets further than the last";
            // As time goes by runs get longer, so that the slowest machine ends.
            const std::chrono::duration<double> time(whole * moment(generator) * (1 + 0.1 * turn));
            const int status =
                run_and_signal(folder_, words, SIGKILL, [&] { std::this_thread::sleep_for(time); });
            if (status == 128 + SIGKILL) continue;
            const std::string said = read_text(folder_.file(".err"));
            ASSERT_EQ(status, 0) << said;
            resumed = nlohmann::json::parse(said.substr(said.find('{'))).at("resumed_spp");
            break;
        }
        EXPECT_GT(resumed, 0);
        expect_same("whole.exr", "part.exr");
        EXPECT_FALSE(exists("part.checkpoint.exr"));
        for (const std::string& name : folder_.names()) {
            EXPECT_EQ(name.find(".tmp"), std::string::npos) << name << " was left behind";
        }
    }
}

TEST_F(FilmCommand, AnInterruptSavesWhatIsDoneAndSaysHowToGoOn) {
    // Many times the length of what is done before a signal comes.
    const std::string render = "render s.pbrt -q --spp 1536 -o ";
    const std::vector<std::string> words = {"render",       "s.pbrt", "-q",       "--spp",
                                            "1536",         "-o",     "part.exr", "--resume",
                                            "--checkpoint", "0.04"};
    for (const int signal : {SIGINT, SIGTERM}) {
        const int status = run_and_signal(folder_, words, signal, next_checkpoint());
        const std::string said = read_text(folder_.file(".err"));
        ASSERT_EQ(status, 128 + signal) << said;
        EXPECT_NE(said.find("part.checkpoint.exr"), std::string::npos) << said;
        EXPECT_NE(said.find("--resume goes on"), std::string::npos) << said;
        // The picture so far is the sums' own; before every pixel has samples there is none.
        if (said.find("part.exr holds the") == std::string::npos) continue;
        const ProgramRun merged = run("merge part.checkpoint.exr -o so-far.exr");
        ASSERT_EQ(merged.status, 0) << merged.err;
        expect_same("so-far.exr", "part.exr");
    }
    ASSERT_EQ(run(render + "whole.exr").status, 0);
    const ProgramRun last = run(render + "part.exr --resume");
    ASSERT_EQ(last.status, 0) << last.err;
    expect_same("whole.exr", "part.exr");
    EXPECT_FALSE(exists("part.checkpoint.exr"));
}

TEST_F(FilmCommand, ShardsAreJoinedToThePictureOfOneRun) {
    ASSERT_EQ(run("render s.pbrt -q --spp 80 --stokes -o whole.exr").status, 0);
    for (int shard = 0; shard < 3; ++shard) {
        const std::string i = std::to_string(shard);
        const ProgramRun part = run("render s.pbrt -q --spp 80 --stokes --threads 1 --shard " + i +
                                    "/3 -o part-" + i + ".exr");
        ASSERT_EQ(part.status, 0) << part.err;
    }
    const ProgramRun joined = run("merge part-2.exr part-0.exr part-1.exr -o joined.exr --json");
    ASSERT_EQ(joined.status, 0) << joined.err;
    EXPECT_EQ(nlohmann::json::parse(joined.out).at("spp"), 80);
    expect_same("whole.exr", "joined.exr");
    EXPECT_EQ(run("merge part-0.exr part-0.exr -o joined.exr").status, 2);
    const ProgramRun gap = run("merge part-0.exr part-2.exr -o joined.exr --json");
    EXPECT_EQ(gap.status, 0);
    EXPECT_EQ(nlohmann::json::parse(gap.out).at("missing_spp"), 32);
    EXPECT_NE(gap.err.find("16:48 of each pixel are missing"), std::string::npos) << gap.err;
    const ProgramRun picture = run("merge whole.exr -o joined.exr");
    EXPECT_EQ(picture.status, 2);
    EXPECT_NE(picture.err.find("is no file of sums"), std::string::npos) << picture.err;
    for (const char* bad : {"2/2", "-1/2", "1", "a/b", "0/0", "1/2/3"}) {
        const ProgramRun refused = run(std::string("render s.pbrt -o part.exr --shard=") + bad);
        EXPECT_EQ(refused.status, 2) << bad;
        EXPECT_NE(refused.err.find("expected i/n"), std::string::npos) << refused.err;
    }
}

TEST_F(FilmCommand, ResumingAnotherPictureIsRefused) {
    // Sums of a shard serve as a checkpoint that was left behind.
    ASSERT_EQ(run("render s.pbrt -q --spp 128 --shard 0/2 -o a.checkpoint.exr").status, 0);
    const auto refusal = [&](const std::string& options) {
        const ProgramRun refused = run("render s.pbrt -q -o a.exr --resume " + options);
        EXPECT_EQ(refused.status, 2) << options;
        return refused.err;
    };
    EXPECT_NE(refusal("--spp 64 --seed 5").find("seed 0 against 5"), std::string::npos);
    EXPECT_NE(refusal("--spp 64 --max-depth 2").find("most reflections"), std::string::npos);
    EXPECT_NE(refusal("--spp 64 --shard 1/2").find("another shard"), std::string::npos);
    EXPECT_NE(refusal("--spp 32").find("64 samples a pixel already"), std::string::npos);
    EXPECT_NE(refusal("--spp 8").find("samples a batch"), std::string::npos);
    EXPECT_NE(refusal("--spp 64 --isa sse2").find("--allow-mixed"), std::string::npos);
    write_text(folder_.file("other.pbrt"), std::string(scene) + "# another hash\n");
    const ProgramRun other = run("render other.pbrt -q -o a.exr --resume --spp 64");
    EXPECT_EQ(other.status, 2);
    EXPECT_NE(other.err.find("holds another picture: scene"), std::string::npos) << other.err;

    // What it is a beginning of goes on, and more samples than first planned are no other picture.
    ASSERT_EQ(run("render s.pbrt -q --spp 96 -o whole.exr").status, 0);
    const ProgramRun resumed = run("render s.pbrt -q --spp 96 -o a.exr --resume --json");
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(nlohmann::json::parse(resumed.out).at("resumed_spp"), 64);
    expect_same("whole.exr", "a.exr");
    // Nothing there: from the beginning.
    ASSERT_EQ(run("render s.pbrt -q --spp 96 -o b.exr --resume").status, 0);
    expect_same("whole.exr", "b.exr");
    // A checkpoint without --resume is not gone on from, and that is said.
    ASSERT_EQ(run("render s.pbrt -q --spp 64 --shard 0/2 -o c.checkpoint.exr").status, 0);
    const ProgramRun anew = run("render s.pbrt -q --spp 96 -o c.exr --json");
    EXPECT_NE(anew.err.find("is begun anew"), std::string::npos) << anew.err;
    EXPECT_EQ(nlohmann::json::parse(anew.out).at("resumed_spp"), 0);
    expect_same("whole.exr", "c.exr");
}

TEST_F(FilmCommand, ClearsAwayWhatARunLeftThatWasKilledWhileItWroteThePicture) {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);  // no process has its number now
    const std::string left = ".part." + std::to_string(child) + "-15.tmp.exr";
    for (const char* how : {"--spp 16", "--spp 32 --resume", "--spp 32 --shard 0/2"}) {
        write_text(folder_.file(left), "half a picture");
        ASSERT_EQ(run(std::string("render s.pbrt -q -o part.exr ") + how).status, 0) << how;
        EXPECT_FALSE(exists(left)) << how;
    }
}

TEST_F(FilmCommand, CheckpointsDoNotChangeThePicture) {
    ASSERT_EQ(run("render s.pbrt -q --spp 256 -o a.exr --checkpoint 0").status, 0);
    const ProgramRun often = run("render s.pbrt -q --spp 256 -o b.exr --checkpoint 0.05 --json");
    ASSERT_EQ(often.status, 0) << often.err;
    EXPECT_GT(nlohmann::json::parse(often.out).at("checkpoints"), 0);
    expect_same("a.exr", "b.exr");
    EXPECT_EQ(run("render s.pbrt --spp 4 -o b.exr --checkpoint -1").status, 2);
    // Where a checkpoint cannot be written the picture is made all the same, and it is said.
    std::filesystem::create_directory(folder_.file("c.checkpoint.exr"));
    const ProgramRun without = run("render s.pbrt -q --spp 256 -o c.exr --checkpoint 0.05");
    EXPECT_EQ(without.status, 0) << without.err;
    EXPECT_NE(without.err.find("checkpoint could not be written"), std::string::npos);
    expect_same("a.exr", "c.exr");
    // Nothing lies beside a device.
    EXPECT_EQ(run("render s.pbrt -q --spp 4 -o /dev/null").status, 0);
    EXPECT_EQ(run("render s.pbrt -q --spp 4 -o /dev/null --resume").status, 2);
}

bool has_mpi() {
    return std::system("command -v mpirun > /dev/null 2>&1") == 0 &&
           std::filesystem::exists(DRUDE_BINARY_DIR "/drude-mpi.so");
}

TEST_F(FilmCommand, ProcessesUnderMpirunMakeThePictureOfOne) {
    if (!has_mpi()) GTEST_SKIP() << "no mpirun, or the program was built without Open MPI";
    // Tests may run as root in a container of two processors; that is not what is tested.
    const std::string mpirun =
        "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl=self,vader,tcp; mpirun -n ";
    for (const std::string how : {"--spp 80 --stokes", "--spp 32 --spectral"}) {
        ASSERT_EQ(run("render s.pbrt -q -o whole.exr " + how).status, 0);
        for (const std::string ranks : {"1", "2", "3"}) {
            const ProgramRun joint =
                run("render s.pbrt -q --json -o joint.exr " + how, mpirun + ranks + " ");
            ASSERT_EQ(joint.status, 0) << joint.err;
            EXPECT_EQ(nlohmann::json::parse(joint.out).at("processes"), std::stoi(ranks));
            expect_same("whole.exr", "joint.exr");
        }
    }
    const ProgramRun refused = run("render s.pbrt -q -o joint.exr --error 0.1", mpirun + "2 ");
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("give a number of samples"), std::string::npos) << refused.err;
}

// As an MPI launcher starts it, where the module is not to be found.
TEST_F(FilmCommand, WithoutTheModuleALauncherIsAnsweredClearly) {
    std::filesystem::create_directory(folder_.file("bin"));
    std::filesystem::copy(DRUDE_BINARY_DIR "/drude", folder_.file("bin/drude"));
    const std::string command = "cd '" + folder_.path().string() +
                                "' && OMPI_COMM_WORLD_SIZE=2 bin/drude render s.pbrt -o a.exr "
                                "> .out 2> .err";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3);
    const std::string said = read_text(folder_.file(".err"));
    EXPECT_NE(said.find("drude-mpi.so is missing"), std::string::npos) << said;
    EXPECT_NE(said.find("libopenmpi-dev"), std::string::npos) << said;
}

}  // namespace
}  // namespace drude
