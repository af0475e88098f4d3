#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

#include "base/error.h"
#include "base/files.h"
#include "image/exr_rows.h"
#include "image/image.h"
#include "shared_data.h"
#include "temporary_folder.h"

namespace drude {
namespace {

Image sample(int width, int height, const std::vector<std::string>& names) {
    std::mt19937 generator(3);
    std::normal_distribution<float> normal(0.0F, 10.0F);
    Image image;
    image.width = width;
    image.height = height;
    for (const std::string& name : names) {
        for (float& value : image.add(name).data) value = normal(generator);
    }
    return image;
}

// The cause and the message of what a call throws.
template <class Call>
std::pair<int, std::string> failure(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return {static_cast<int>(error.cause()), error.message()};
    }
    return {0, "nothing thrown"};
}

constexpr int user = 2, outside = 3;

TEST(Exr, NamesValuesAndAttributesComeBackAsTheyWent) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    // Alphabetical, which is the order of every OpenEXR file.
    Image image = sample(
        37, 21,
        {"B", "G", "R", "S0.500,000000nm", "S3.780,000000nm", "a name with blanks", "variance.R"});
    image.channels.back().data[0] = std::numeric_limits<float>::infinity();
    image.channels.back().data[1] = -0.0F;
    image.channels.back().data[2] = std::numeric_limits<float>::denorm_min();
    image.channels.back().data[3] = std::nanf("");
    image.attributes["sceneHash"] = std::string("0123abc");
    image.attributes["spectralLayoutVersion"] = std::string("1.0");
    image.attributes["batches"] = 16;
    image.attributes["negative"] = -2147483647;
    image.attributes["exposure"] = 0.1F;
    for (const Compression compression : {Compression::none, Compression::piz, Compression::zip}) {
        write_exr(path, image, compression);
        const Image back = read_exr(path);
        ASSERT_EQ(back.width, 37);
        ASSERT_EQ(back.height, 21);
        ASSERT_EQ(back.channels.size(), image.channels.size());
        for (size_t c = 0; c < image.channels.size(); ++c) {
            EXPECT_EQ(back.channels[c].name, image.channels[c].name);
            EXPECT_EQ(std::memcmp(back.channels[c].data.data(), image.channels[c].data.data(),
                                  image.pixels() * sizeof(float)),
                      0)
                << image.channels[c].name;
        }
        EXPECT_EQ(back.attributes, image.attributes);
    }
    EXPECT_EQ(folder.names().size(), 1U);
    EXPECT_EQ(image.number("batches", 0), 16);
    EXPECT_EQ(image.number("absent", -1), -1);
    EXPECT_EQ(image.text("sceneHash"), "0123abc");
    EXPECT_EQ(image.text("batches"), "");
}

TEST(Exr, TallPictureIsReadInSeveralSteps) {
    const TemporaryFolder folder;
    const std::string path = folder.file("tall.exr");
    const Image image = sample(3, 1031, {"Y"});
    write_exr(path, image, Compression::zip);
    EXPECT_EQ(read_exr(path).channels[0].data, image.channels[0].data);
}

TEST(Exr, CompressionMakesAFlatPictureSmaller) {
    const TemporaryFolder folder;
    Image image = sample(64, 64, {});
    image.add("Y");
    write_exr(folder.file("none.exr"), image, Compression::none);
    write_exr(folder.file("zip.exr"), image, Compression::zip);
    write_exr(folder.file("piz.exr"), image, Compression::piz);
    const auto none = std::filesystem::file_size(folder.file("none.exr"));
    EXPECT_GT(none, 64U * 64U * 4U);
    EXPECT_LT(std::filesystem::file_size(folder.file("zip.exr")), none / 4);
    EXPECT_LT(std::filesystem::file_size(folder.file("piz.exr")), none / 4);
}

TEST(Exr, FullDiskIsAnOutsideErrorAndLeavesNothingBehind) {
    const TemporaryFolder folder;
    const std::string path = folder.file("big.exr");
    const Image small = sample(8, 8, {"Y"});
    write_exr(path, small, Compression::none);
    const std::string before = read_file(path);
    const Image image = sample(256, 256, {"B", "G", "R"});

    const auto old_handler = signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    // Within the header, within the pixels, and where only the last bytes do not fit.
    for (const Compression compression : {Compression::none, Compression::piz, Compression::zip}) {
        const std::string whole_path = folder.file("whole.exr");
        write_exr(whole_path, image, compression);
        const auto whole = std::filesystem::file_size(whole_path);
        std::filesystem::remove(whole_path);
        for (const auto limit : {uintmax_t{0}, uintmax_t{100}, whole / 2, whole - 1}) {
            rlimit limited = old_limit;
            limited.rlim_cur = static_cast<rlim_t>(limit);
            ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
            const auto thrown = failure([&] { write_exr(path, image, compression); });
            ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old_limit), 0);
            EXPECT_EQ(thrown.first, outside) << "limit " << limit;
            EXPECT_NE(thrown.second.find(path), std::string::npos) << thrown.second;
            EXPECT_NE(thrown.second.find("too large"), std::string::npos) << thrown.second;
            EXPECT_EQ(folder.names().size(), 1U);
            EXPECT_EQ(read_file(path), before) << "the older file must stay";
        }
    }
    signal(SIGXFSZ, old_handler);
    write_exr(path, image, Compression::zip);
    EXPECT_EQ(read_exr(path).width, 256);
}

TEST(Exr, FolderThatIsNotThereIsToldApart) {
    const TemporaryFolder folder;
    const Image image = sample(2, 2, {"Y"});
    const auto thrown =
        failure([&] { write_exr(folder.file("no/such/a.exr"), image, Compression::none); });
    EXPECT_EQ(thrown.first, user) << thrown.second;
    EXPECT_NE(thrown.second.find("no/such"), std::string::npos) << thrown.second;
}

TEST(Exr, MissingEmptyAndForeignFilesAreUserErrors) {
    const TemporaryFolder folder;
    write_file(folder.file("empty.exr"), "");
    write_file(folder.file("text.exr"), "this is no picture at all");
    EXPECT_EQ(failure([&] { read_exr(folder.file("absent.exr")); }).first, user);
    EXPECT_EQ(failure([&] { read_exr(folder.file("empty.exr")); }).first, user);
    EXPECT_EQ(failure([&] { read_exr(folder.file("text.exr")); }).first, user);
    EXPECT_EQ(failure([&] { read_exr(folder.file("")); }).first, user);
}

TEST(Exr, EveryTruncationIsAUserError) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    Image image = sample(20, 40, {"B", "G", "R"});
    image.attributes["seed"] = 1;
    for (const Compression compression : {Compression::none, Compression::piz, Compression::zip}) {
        write_exr(path, image, compression);
        const std::string bytes = read_file(path);
        for (size_t length = 0; length < bytes.size(); length += 1 + length / 40) {
            std::ofstream(path, std::ios::binary) << bytes.substr(0, length);
            const auto thrown = failure([&] { read_exr(path); });
            EXPECT_EQ(thrown.first, user) << length << ": " << thrown.second;
        }
    }
}

// Any byte of the header and of the tables may be damaged: an error or a picture, never a crash.
TEST(Exr, DamagedHeadersNeverCrash) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, sample(12, 12, {"B", "G", "R"}), Compression::zip);
    const std::string bytes = read_file(path);
    size_t refused = 0;
    for (size_t at = 4; at < std::min<size_t>(bytes.size(), 420); ++at) {
        for (const int value : {0x00, 0x01, 0x7f, 0xff}) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(value);
            std::ofstream(path, std::ios::binary) << damaged;
            const auto thrown = failure([&] { read_exr(path); });
            EXPECT_TRUE(thrown.first == 0 || thrown.first == user) << at << ": " << thrown.second;
            refused += thrown.first == user ? 1 : 0;
        }
    }
    EXPECT_GT(refused, 100U);
}

std::string with_data_window(std::string bytes, int x0, int y0, int x1, int y1) {
    const std::string key("dataWindow\0box2i\0", 17);
    const size_t at = bytes.find(key) + key.size() + 4;
    const int32_t window[4] = {x0, y0, x1, y1};
    std::memcpy(&bytes[at], window, sizeof window);
    return bytes;
}

TEST(Exr, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    write_exr(path, sample(12, 12, {"B", "G", "R"}), Compression::zip);
    const std::string bytes = read_file(path);
    const int big = 1 << 30;
    const int windows[][4] = {{0, 0, 1 << 14, 1 << 14},  // just above 2^28
                              {0, 0, 5, -5},
                              {0, 0, big, 3},
                              {0, 0, 3, big},
                              {-big, -big, big, big},
                              {7, 7, 6, 6},
                              {0, 0, (1 << 14) - 1, (1 << 14) - 1}};  // 2^28, but no data for it
    for (const auto& w : windows) {
        write_file(path, with_data_window(bytes, w[0], w[1], w[2], w[3]));
        rusage before{}, after{};
        getrusage(RUSAGE_SELF, &before);
        const auto thrown = failure([&] { read_exr(path); });
        getrusage(RUSAGE_SELF, &after);
        EXPECT_EQ(thrown.first, user) << w[2] << " " << w[3] << ": " << thrown.second;
        EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 512 * 1024) << w[2] << " " << w[3];
    }
}

TEST(Exr, ImagesThatCannotBeWrittenAreOurOwnMistake) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    Image wrong_size = sample(4, 4, {"Y"});
    wrong_size.channels[0].data.pop_back();
    EXPECT_THROW(write_exr(path, wrong_size, Compression::none), std::logic_error);
    EXPECT_THROW(write_exr(path, sample(4, 4, {}), Compression::none), std::logic_error);
    EXPECT_THROW(write_exr(path, sample(4, 4, {"Y", "Y"}), Compression::none), std::logic_error);
    Image reserved = sample(4, 4, {"Y"});
    reserved.attributes["compression"] = 1;
    EXPECT_THROW(write_exr(path, reserved, Compression::none), std::logic_error);
    EXPECT_EQ(folder.names().size(), 0U);
}

TEST(Exr, AskingForAnAbsentChannelNamesFileChannelsAndTheNearest) {
    const Image image = sample(2, 2, {"B", "G", "R", "S0.R"});
    const auto thrown = failure([&] { image.at("S1.R", "here.exr"); });
    EXPECT_EQ(thrown.first, user);
    for (const char* part : {"here.exr", "'S1.R'", "'S0.R'", "B G R"}) {
        EXPECT_NE(thrown.second.find(part), std::string::npos) << thrown.second;
    }
}

TEST(Exr, RgbValuesFallBackToLuminanceAndToS0) {
    Image grey = sample(2, 1, {"Y"});
    grey.channels[0].data = {1.0F, 2.0F};
    EXPECT_EQ(rgb_values(grey, "g"), (std::vector<float>{1, 1, 1, 2, 2, 2}));
    Image stokes = sample(1, 1, {"S0.B", "S0.G", "S0.R"});
    for (size_t c = 0; c < 3; ++c) stokes.channels[c].data = {static_cast<float>(c)};
    EXPECT_EQ(rgb_values(stokes, "s"), (std::vector<float>{2, 1, 0}));
    EXPECT_EQ(failure([&] { rgb_values(sample(1, 1, {"Q"}), "q"); }).first, user);
    EXPECT_EQ(failure([&] { rgb_values(sample(1, 1, {"B", "R"}), "q"); }).first, user);
}

// A spectral, polarised picture that another renderer (ART 2.0.4) wrote.
TEST(Exr, ReadsTheSpectralPolarisedPictureOfAnotherRenderer) {
    const std::string path = shared_data("exr/art_polarised.exr");
    DRUDE_NEED_SHARED(path);
    const Image image = read_exr(path);
    EXPECT_EQ(image.width, 32);
    EXPECT_EQ(image.height, 32);
    EXPECT_EQ(image.text("spectralLayoutVersion"), "1.0");
    EXPECT_EQ(image.text("polarisationHandedness"), "right");
    EXPECT_EQ(image.text("emissiveUnits"), "W.m^-2.sr^-1");
    double polarised = 0.0;
    for (int wavelength = 400; wavelength <= 680; wavelength += 40) {
        const auto stokes = [&](int s) -> const Channel& {
            return image.at(
                "S" + std::to_string(s) + "." + std::to_string(wavelength) + ",000000nm", path);
        };
        for (size_t i = 0; i < image.pixels(); ++i) {
            const double s0 = static_cast<double>(stokes(0).data[i]);
            double square = 0.0;
            for (int s = 1; s <= 3; ++s) {
                square += std::pow(static_cast<double>(stokes(s).data[i]), 2);
            }
            ASSERT_GE(s0, 0.0);
            // Stored in half by the other renderer, so physical within its rounding.
            ASSERT_LE(std::sqrt(square), s0 * 1.01 + 1e-6) << wavelength << " " << i;
            polarised += std::sqrt(square);
        }
    }
    EXPECT_GT(polarised, 0.0);
    for (const char* name : {"R", "G", "B"}) EXPECT_NE(image.find(name), nullptr);
}

// Rows of whole numbers and floats come back bit for bit, in any order of reading.
TEST(ExrRows, WordsComeBackAsTheyWent) {
    const TemporaryFolder folder;
    ExrPicture picture;
    picture.width = 13;
    picture.height = 70;  // more than are read at once
    picture.channels = {{"a", ExrSamples::uint32}, {"b", ExrSamples::float32}};
    picture.attributes["note"] = std::string("sums");
    const auto word = [](int c, int x, int y) {
        // Whole numbers of all bits; floats without NaN, whose bits need not survive.
        const uint32_t mixed =
            static_cast<uint32_t>(c * 7919 + x * 104729 + y * 1299709) * 2654435761u;
        return c == 0 ? mixed : mixed & 0xbf7fffffu;
    };
    for (const Compression compression : {Compression::none, Compression::piz, Compression::zip}) {
        write_exr_rows(folder.file("a.exr"), picture, compression, [&](int y, uint32_t* words) {
            for (int c = 0; c < 2; ++c) {
                for (int x = 0; x < 13; ++x) *words++ = word(c, x, y);
            }
        });
        ExrRowReader reader(folder.file("a.exr"));
        ASSERT_EQ(reader.picture().channels.size(), 2U);
        EXPECT_EQ(reader.picture().channels[0].samples, ExrSamples::uint32);
        EXPECT_EQ(reader.picture().attributes, picture.attributes);
        for (const int y : {0, 69, 31, 32, 5, 68, 40}) {
            std::vector<uint32_t> words(26);
            reader.read(y, words.data());
            for (int i = 0; i < 26; ++i) ASSERT_EQ(words[i], word(i / 13, i % 13, y)) << y;
        }
    }
    // What the source throws is passed on, and no file is left.
    EXPECT_THROW(write_exr_rows(folder.file("b.exr"), picture, Compression::piz,
                                [](int, uint32_t*) { throw std::out_of_range("row"); }),
                 std::out_of_range);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.exr"});
}

}  // namespace
}  // namespace drude
