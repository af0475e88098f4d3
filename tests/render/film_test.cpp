// Pictures from shards, damaged files of sums, steps and the error that ends a picture.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/files.h"
#include "render/film_merge.h"
#include "render/film_partial.h"
#include "render/film_schedule.h"
#include "temporary_folder.h"
#include "test_scenes.h"

namespace drude {
namespace {

Scene copper(int size) {
    return sphere_under_sky(
        "LightSource \"distant\" \"point3 from\" [1 1 -2]\n"
        "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" "
        "\"float beta\" 0.3\n",
        size);
}

RenderOptions options_for(int samples) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.quiet = true;
    return options;
}

void expect_same_picture(const Image& a, const Image& b) {
    ASSERT_EQ(a.channels.size(), b.channels.size());
    for (const Channel& channel : a.channels) {
        const Channel* other = b.find(channel.name);
        ASSERT_NE(other, nullptr) << channel.name;
        EXPECT_EQ(other->data, channel.data) << channel.name;
    }
}

TEST(Film, ShardsMakeThePictureOfOneRun) {
    const TemporaryFolder folder;
    const Scene scene = copper(21);
    for (const bool spectral : {false, true}) {
        for (const bool stokes : {false, true}) {
            RenderOptions options = options_for(7 * 16);
            options.spectral = spectral;
            options.stokes = stokes;
            options.threads = 2;
            const RenderResult whole = render(scene, options);
            options.threads = 1;
            options.shards = 3;
            std::vector<std::string> parts;
            for (const int shard : {2, 0, 1}) {
                options.shard = shard;
                const RenderedFilm film = render_film(scene, options);
                parts.push_back(folder.file("part-" + std::to_string(shard) + ".exr"));
                write_partial(parts.back(), film.part, film.sums, "test");
            }
            const MergeResult merged =
                merge_partials(parts, folder.file("merged.exr"), false, "test");
            EXPECT_TRUE(merged.warnings.empty());
            EXPECT_EQ(merged.part.fewest, 7U);
            EXPECT_EQ(merged.part.counts.rays, whole.rays);
            const Image picture = read_exr(folder.file("merged.exr"));
            expect_same_picture(whole.image, picture);
            EXPECT_EQ(picture.number("samples", 0), 112);
            EXPECT_EQ(picture.text("sampleRange"), "0:112");
        }
    }
}

TEST(Film, MergeRefusesWhatIsNotOnePictureAndSaysWhy) {
    const TemporaryFolder folder;
    Scene scene = copper(8);
    RenderOptions options = options_for(64);
    options.shards = 2;
    const auto part = [&](const std::string& name) {
        const RenderedFilm film = render_film(scene, options);
        write_partial(folder.file(name), film.part, film.sums, "test");
        return folder.file(name);
    };
    const std::string first = part("first.exr");
    const auto refusal = [&](const std::string& other) {
        return message_of([&] { merge_partials({first, other}, folder.file("m.exr"), false, ""); });
    };
    options.shard = 1;
    const std::string second = part("second.exr");
    EXPECT_EQ(refusal(second), "nothing thrown");
    EXPECT_NE(refusal(first).find("overlap"), std::string::npos);
    options.seed = 77;
    EXPECT_NE(refusal(part("a.exr")).find("seed 0 against 77"), std::string::npos);
    options.seed.reset();
    options.stokes = true;
    EXPECT_NE(refusal(part("b.exr")).find("against stokes"), std::string::npos);
    options.stokes = false;
    options.wavelengths = 16;
    EXPECT_NE(refusal(part("c.exr")).find("wavelengths 8 against 16"), std::string::npos);
    options.wavelengths = 0;
    options.samples_per_pixel = 96;
    EXPECT_NE(refusal(part("d.exr")).find("64 samples against 96"), std::string::npos);
    options.samples_per_pixel = 64;
    scene.max_depth = 3;
    EXPECT_NE(refusal(part("e.exr")).find("most reflections"), std::string::npos);
    scene = copper(9);
    EXPECT_NE(refusal(part("f.exr")).find("resolution 8x8 against 9x9"), std::string::npos);

    scene = copper(8);
    RenderedFilm film = render_film(scene, options);
    film.part.job.instruction_set = "other/sse2";
    write_partial(folder.file("g.exr"), film.part, film.sums, "test");
    EXPECT_NE(refusal(folder.file("g.exr")).find("--allow-mixed"), std::string::npos);
    const MergeResult mixed =
        merge_partials({first, folder.file("g.exr")}, folder.file("m.exr"), true, "");
    EXPECT_NE(mixed.part.job.instruction_set.find("+other/sse2"), std::string::npos);

    // A gap is fewer samples, and said.
    const MergeResult half = merge_partials({second}, folder.file("m.exr"), false, "");
    EXPECT_EQ(half.missing, 2U);
    ASSERT_EQ(half.warnings.size(), 1U);
    EXPECT_NE(half.warnings[0].find("samples 0:32 of each pixel are missing"), std::string::npos);
    EXPECT_EQ(read_exr(folder.file("m.exr")).number("samples", 0), 32);
    EXPECT_NE(message_of([&] { merge_partials({first}, first, false, ""); }).find("is a part"),
              std::string::npos);
}

// Whatever byte is damaged: the file is refused, or says the same sums.
TEST(Film, DamagedSumsAreNeverTakenForGood) {
    const TemporaryFolder folder;
    const RenderedFilm film = render_film(copper(6), options_for(32));
    const std::string path = folder.file("part.exr");
    write_partial(path, film.part, film.sums, "test");
    const std::string bytes = read_file(path);
    const auto words = [&](const std::string& name) {
        PartialReader reader(name);
        FilmSums sums(reader.part().job.layout());
        std::vector<uint32_t> all;
        for (int y = 0; y < sums.layout().height; ++y) {
            reader.read_row(y, &sums, static_cast<size_t>(y) * sums.layout().width);
        }
        for (size_t p = 0; p < sums.layout().pixels(); ++p) {
            std::vector<uint32_t> pixel(sums.layout().words());
            sums.to_words(p, pixel.data());
            all.insert(all.end(), pixel.begin(), pixel.end());
        }
        return all;
    };
    const std::vector<uint32_t> good = words(path);
    std::mt19937 generator(1);
    int refused = 0;
    const std::string damaged = folder.file("damaged.exr");
    for (size_t turn = 0; turn < 600; ++turn) {
        std::string copy = bytes;
        // Every third in the header, which is short beside the sums.
        const size_t at =
            generator() % (turn % 3 == 0 ? std::min<size_t>(1500, bytes.size()) : bytes.size());
        copy[at] = static_cast<char>(copy[at] ^ (1 << generator() % 8));
        write_file(damaged, copy);
        try {
            EXPECT_EQ(words(damaged), good) << "byte " << at;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            ++refused;
        }
    }
    EXPECT_GT(refused, 400);
    for (const size_t length : {size_t{0}, size_t{3}, size_t{500}, bytes.size() - 1}) {
        write_file(damaged, bytes.substr(0, length));
        EXPECT_THROW(words(damaged), Error) << length;
    }
}

TEST(Film, StepsEndAtTheCountAndLooksAreTheSameFromAnywhere) {
    const FilmSchedule count({37, {}, {}});
    uint32_t done = 0;
    int steps = 0;
    for (uint32_t next = 0; (next = count.next(done, 1)) != done; done = next, ++steps) {
        ASSERT_GT(next, done);
    }
    EXPECT_EQ(done, 37U);
    EXPECT_EQ(steps, 5);
    EXPECT_EQ(FilmSchedule({0, {}, {}}).next(0, 0), 0U);
    EXPECT_EQ(FilmSchedule({1, {}, {}}).next(0, 0), 1U);

    const FilmSchedule error({1000, {}, 0.1});
    done = 0;
    for (uint32_t next = 0; (next = error.next(done, 1)) != done; done = next) {
        EXPECT_TRUE(next == 1000 || FilmSchedule::is_look(next)) << next;
        EXPECT_LE(next, std::max(4U, done + std::max(1U, done / 8)));
        for (uint32_t between = done + 1; between < next; ++between) {
            EXPECT_FALSE(FilmSchedule::is_look(between) && between < next) << between;
            EXPECT_TRUE(error.next(between, 1) == next) << between;
        }
    }
    EXPECT_EQ(done, 1000U);

    // A batch takes a second: five of them in 5.5 s, one at least.
    const FilmSchedule time({1000, 5.5, {}});
    done = 0;
    for (uint32_t next = 0; (next = time.next(done, done)) != done;) done = next;
    EXPECT_EQ(done, 5U);
    EXPECT_EQ(FilmSchedule({1000, 1e-9, {}}).next(0, 0), 1U);
}

// The estimate is the error against a picture of far more samples, by its own definition.
TEST(Film, TheEstimatedErrorIsTheTrueOne) {
    const Scene scene = copper(24);
    RenderOptions options = options_for(1 << 13);
    options.seed = 1000;
    const RenderedFilm truth = render_film(scene, options);
    const size_t pixels = truth.sums.layout().pixels();
    const auto count = static_cast<double>(pixels);
    for (const double wanted : {0.05, 0.02}) {
        options.samples_per_pixel.reset();
        options.error = wanted;
        double estimated = 0, seen = 0;
        constexpr int seeds = 6;
        for (uint64_t seed = 0; seed < seeds; ++seed) {
            options.seed = seed;
            const RenderedFilm film = render_film(scene, options);
            ASSERT_TRUE(film.summary.error);
            EXPECT_LE(*film.summary.error, wanted);
            EXPECT_TRUE(FilmSchedule::is_look(film.part.fewest));
            EXPECT_EQ(film.sums.most_batches(), film.part.fewest);
            estimated += *film.summary.error * *film.summary.error / seeds;
            double level = 0, total = 0;
            const auto square = [&](size_t p) {
                double sum = 0;
                for (int c = 0; c < 3; ++c) sum += std::pow(film.sums.mean(p, 0, c), 2);
                return sum;
            };
            for (size_t p = 0; p < pixels; ++p) level += std::sqrt(square(p)) / count;
            for (size_t p = 0; p < pixels; ++p) {
                double difference = 0;
                for (int c = 0; c < 3; ++c) {
                    difference += std::pow(film.sums.mean(p, 0, c) - truth.sums.mean(p, 0, c), 2);
                }
                total += difference / (square(p) + 0.01 * level * level);
            }
            seen += total / count / seeds;
        }
        EXPECT_NEAR(std::sqrt(seen / estimated), 1, 0.12) << wanted;
    }
}

TEST(Film, AnErrorEndsThePictureOfThatCount) {
    const Scene scene = copper(16);
    RenderOptions options = options_for(0);
    options.samples_per_pixel.reset();
    options.error = 0.008;
    options.threads = 1;
    const RenderResult one = render(scene, options);
    options.threads = 2;
    expect_same_picture(one.image, render(scene, options).image);
    EXPECT_GT(one.samples_per_pixel, 64);
    expect_same_picture(one.image, render(scene, options_for(one.samples_per_pixel)).image);
    // --spp is the most that may be.
    options.samples_per_pixel = 64;
    options.error = 1e-6;
    EXPECT_EQ(render(scene, options).samples_per_pixel, 64);
}

TEST(Film, ATimeEndsThePictureWithAsManyBatchesEverywhere) {
    RenderOptions options = options_for(0);
    options.samples_per_pixel.reset();
    options.seconds = 0.2;
    const RenderedFilm film = render_film(copper(16), options);
    EXPECT_GE(film.part.fewest, 1U);
    EXPECT_EQ(film.sums.most_batches(), film.part.fewest);
    options.seconds = 1e-9;
    EXPECT_EQ(render(copper(16), options).batches, 1);
}

TEST(Film, OptionsThatContradictEachOtherAreRefused) {
    const auto refusal = [](const std::function<void(RenderOptions*)>& change) {
        RenderOptions options = options_for(16);
        change(&options);
        return message_of([&] { render(copper(4), options); });
    };
    EXPECT_NE(refusal([](RenderOptions* o) { o->seconds = -1; }).find("time of -1"),
              std::string::npos);
    EXPECT_NE(refusal([](RenderOptions* o) { o->error = std::nan(""); }).find("relative error"),
              std::string::npos);
    EXPECT_NE(refusal([](RenderOptions* o) { o->shards = 2, o->shard = 2; }).find("shard 2/2"),
              std::string::npos);
    EXPECT_NE(refusal([](RenderOptions* o) {
                  o->shards = 2, o->error = 0.1;
              }).find("give a number of samples"),
              std::string::npos);
    EXPECT_NE(refusal([](RenderOptions* o) {
                  o->samples_per_pixel = 2000000000;
              }).find("expected at most 16776960"),
              std::string::npos);
}

// Light beyond float32: said, and no infinity in the picture.
TEST(Film, LightBeyondFloatIsSaidAndLeavesNoInfinity) {
    Scene scene = sphere_under_sky("Material \"diffuse\"", 4);
    for (double& value : scene.infinite_lights[0].radiance) value = 1e38;
    const RenderResult result = render_quietly(scene, 64);
    for (const Channel& channel : result.image.channels) {
        for (const float value : channel.data) ASSERT_TRUE(std::isfinite(value)) << channel.name;
    }
    bool said = false;
    for (const std::string& warning : result.warnings) {
        said = said || warning.find("beyond the range") != std::string::npos ||
               warning.find("were not numbers") != std::string::npos;
    }
    EXPECT_TRUE(said);
}

}  // namespace
}  // namespace drude
