#include "render/film_sums.h"

#include <algorithm>
#include <cstring>

#include "render/batch_tracer.h"

namespace drude {

namespace {

constexpr int row_digits = 3 * 2 * sum_digits;
constexpr int level_words = spectral_bins / 4;
static_assert(spectral_bins % 4 == 0, "levels of the bins are stored four a word");
// Above it a mean would be no float32.
constexpr double largest_value = 0x1p127;
static_assert(largest_value <= 0x1p511, "what the highest level holds");

// What is stored for values up to `magnitude`.
uint8_t stored_level(double magnitude) {
    if (!(magnitude > 0)) return 0;
    return static_cast<uint8_t>(window_level(magnitude) - lowest_level + 1);
}

constexpr uint8_t highest_stored = highest_level - lowest_level + 1;

bool holds_only_sums(const BatchResult& batch, const FilmLayout& layout) {
    bool good = true;
    for (int row = 0; row < layout.rows; ++row) {
        for (const double value : batch.rgb[row]) good = good && std::abs(value) < largest_value;
        if (!layout.spectral) continue;
        for (const float value : batch.spectral[row]) good = good && std::isfinite(value);
    }
    return good;
}

// Digits of this many terms: none is larger, and a level of 0 stands for zeros alone.
bool possible_digits(const int32_t* digits, int count, uint32_t terms, uint8_t level) {
    const int64_t most = level == 0 ? 0 : static_cast<int64_t>(terms) << 15;
    return std::all_of(digits, digits + count,
                       [&](int32_t d) { return std::abs(static_cast<int64_t>(d)) <= most; });
}

}  // namespace

size_t FilmLayout::words() const {
    const size_t spectral_words = spectral ? level_words + spectral_bins * sum_digits : 0;
    return 2 + static_cast<size_t>(rows) * (row_digits + spectral_words);
}

FilmSums::FilmSums(const FilmLayout& layout)
    : layout_(layout),
      batches_(layout.pixels(), 0),
      rgb_levels_(layout.pixels() * layout.rows, 0),
      rgb_(layout.pixels() * layout.rows * row_digits, 0),
      spectral_levels_(layout.spectral ? layout.pixels() * layout.rows * spectral_bins : 0, 0),
      spectral_(spectral_levels_.size() * sum_digits, 0) {}

int32_t* FilmSums::rgb_digits(size_t pixel, int row, int c) {
    return &rgb_[(pixel * layout_.rows + row) * row_digits + c * 2 * sum_digits];
}
const int32_t* FilmSums::rgb_digits(size_t pixel, int row, int c) const {
    return &rgb_[(pixel * layout_.rows + row) * row_digits + c * 2 * sum_digits];
}

void FilmSums::raise_rgb(size_t pixel, int row, uint8_t level) {
    uint8_t& stored = rgb_levels_[pixel * layout_.rows + row];
    if (level <= stored) return;
    const int from = level_of(stored), to = level_of(level);
    // Digits of a level of 0 are zeros, wherever they stand.
    for (int c = 0; c < 3; ++c) {
        int32_t* digits = rgb_digits(pixel, row, c);
        raise_digits(leading_digit(to) - leading_digit(from), digits);
        raise_digits(leading_digit_of_squares(to) - leading_digit_of_squares(from),
                     digits + sum_digits);
    }
    stored = level;
}

void FilmSums::raise_spectral(size_t at, uint8_t level) {
    uint8_t& stored = spectral_levels_[at];
    if (level <= stored) return;
    raise_digits(leading_digit(level_of(level)) - leading_digit(level_of(stored)),
                 &spectral_[at * sum_digits]);
    stored = level;
}

bool FilmSums::add(size_t pixel, const BatchResult& batch) {
    ++batches_[pixel];
    if (!holds_only_sums(batch, layout_)) return false;
    for (int row = 0; row < layout_.rows; ++row) {
        const double* rgb = batch.rgb[row];
        raise_rgb(pixel, row,
                  stored_level(std::max({std::abs(rgb[0]), std::abs(rgb[1]), std::abs(rgb[2])})));
        const uint8_t stored = rgb_levels_[pixel * layout_.rows + row];
        if (stored == 0) continue;
        const int level = level_of(stored);
        for (int c = 0; c < 3; ++c) {
            int32_t* digits = rgb_digits(pixel, row, c);
            add_digits(rgb[c], leading_digit(level), digits);
            add_digits(rgb[c] * rgb[c], leading_digit_of_squares(level), digits + sum_digits);
        }
    }
    if (!layout_.spectral) return true;
    for (int row = 0; row < layout_.rows; ++row) {
        for (int bin = 0; bin < spectral_bins; ++bin) {
            const auto value = static_cast<double>(batch.spectral[row][bin]);
            const size_t at = (pixel * layout_.rows + row) * spectral_bins + bin;
            raise_spectral(at, stored_level(std::abs(value)));
            if (spectral_levels_[at] == 0) continue;
            add_digits(value, leading_digit(level_of(spectral_levels_[at])),
                       &spectral_[at * sum_digits]);
        }
    }
    return true;
}

bool FilmSums::add(size_t pixel, const FilmSums& other, size_t other_pixel) {
    if (batches_[pixel] + uint64_t{other.batches_[other_pixel]} > most_terms) return false;
    batches_[pixel] += other.batches_[other_pixel];
    const auto add_all = [](const int32_t* from, int by, int32_t* to) {
        int32_t moved[sum_digits];
        std::copy(from, from + sum_digits, moved);
        raise_digits(by, moved);
        for (int i = 0; i < sum_digits; ++i) to[i] += moved[i];
    };
    for (int row = 0; row < layout_.rows; ++row) {
        const uint8_t theirs = other.rgb_levels_[other_pixel * layout_.rows + row];
        if (theirs == 0) continue;
        raise_rgb(pixel, row, theirs);
        const int from = level_of(theirs);
        const int to = level_of(rgb_levels_[pixel * layout_.rows + row]);
        for (int c = 0; c < 3; ++c) {
            const int32_t* source = other.rgb_digits(other_pixel, row, c);
            int32_t* digits = rgb_digits(pixel, row, c);
            add_all(source, leading_digit(to) - leading_digit(from), digits);
            add_all(source + sum_digits,
                    leading_digit_of_squares(to) - leading_digit_of_squares(from),
                    digits + sum_digits);
        }
    }
    if (!layout_.spectral) return true;
    const size_t bins = static_cast<size_t>(layout_.rows) * spectral_bins;
    for (size_t i = 0; i < bins; ++i) {
        const size_t at = pixel * bins + i, from = other_pixel * bins + i;
        const uint8_t theirs = other.spectral_levels_[from];
        if (theirs == 0) continue;
        raise_spectral(at, theirs);
        add_all(&other.spectral_[from * sum_digits],
                leading_digit(level_of(spectral_levels_[at])) - leading_digit(level_of(theirs)),
                &spectral_[at * sum_digits]);
    }
    return true;
}

uint32_t FilmSums::fewest_batches() const {
    return *std::min_element(batches_.begin(), batches_.end());
}
uint32_t FilmSums::most_batches() const {
    return *std::max_element(batches_.begin(), batches_.end());
}

double FilmSums::sum(size_t pixel, int row, int c) const {
    const uint8_t stored = rgb_levels_[pixel * layout_.rows + row];
    if (stored == 0) return 0;
    return sum_of_digits(leading_digit(level_of(stored)), rgb_digits(pixel, row, c));
}
double FilmSums::sum_of_squares(size_t pixel, int row, int c) const {
    const uint8_t stored = rgb_levels_[pixel * layout_.rows + row];
    if (stored == 0) return 0;
    return sum_of_digits(leading_digit_of_squares(level_of(stored)),
                         rgb_digits(pixel, row, c) + sum_digits);
}
double FilmSums::spectral_sum(size_t pixel, int row, int bin) const {
    const size_t at = (pixel * layout_.rows + row) * spectral_bins + bin;
    if (spectral_levels_[at] == 0) return 0;
    return sum_of_digits(leading_digit(level_of(spectral_levels_[at])),
                         &spectral_[at * sum_digits]);
}

double FilmSums::mean(size_t pixel, int row, int c) const {
    return batches_[pixel] ? sum(pixel, row, c) / batches_[pixel] : 0;
}
double FilmSums::variance(size_t pixel, int row, int c) const {
    const double batches = batches_[pixel];
    if (batches < 2) return 0;
    const double average = mean(pixel, row, c);
    const double spread = sum_of_squares(pixel, row, c) / batches - average * average;
    return std::max(0.0, spread) / (batches - 1);
}
double FilmSums::spectral_mean(size_t pixel, int row, int bin) const {
    return batches_[pixel] ? spectral_sum(pixel, row, bin) / batches_[pixel] : 0;
}

void FilmSums::to_words(size_t pixel, uint32_t* words) const {
    const auto copy = [&words](const auto* values, size_t bytes) {
        std::memcpy(words, values, bytes);
        words += (bytes + 3) / 4;
    };
    const size_t rows = layout_.rows, bins = rows * spectral_bins;
    *words++ = batches_[pixel];
    *words = 0;
    copy(&rgb_levels_[pixel * rows], rows);
    copy(&rgb_[pixel * rows * row_digits], rows * row_digits * sizeof(int32_t));
    if (!layout_.spectral) return;
    copy(&spectral_levels_[pixel * bins], bins);
    copy(&spectral_[pixel * bins * sum_digits], bins * sum_digits * sizeof(int32_t));
}

bool FilmSums::from_words(size_t pixel, const uint32_t* words) {
    const auto copy = [&words](auto* values, size_t bytes) {
        std::memcpy(values, words, bytes);
        words += (bytes + 3) / 4;
    };
    const size_t rows = layout_.rows, bins = rows * spectral_bins;
    const uint32_t terms = batches_[pixel] = *words++;
    if (terms > most_terms) return false;
    copy(&rgb_levels_[pixel * rows], rows);
    copy(&rgb_[pixel * rows * row_digits], rows * row_digits * sizeof(int32_t));
    for (size_t row = pixel * rows; row < (pixel + 1) * rows; ++row) {
        if (rgb_levels_[row] > highest_stored ||
            !possible_digits(&rgb_[row * row_digits], row_digits, terms, rgb_levels_[row])) {
            return false;
        }
    }
    if (!layout_.spectral) return true;
    copy(&spectral_levels_[pixel * bins], bins);
    copy(&spectral_[pixel * bins * sum_digits], bins * sum_digits * sizeof(int32_t));
    for (size_t at = pixel * bins; at < (pixel + 1) * bins; ++at) {
        if (spectral_levels_[at] > highest_stored ||
            !possible_digits(&spectral_[at * sum_digits], sum_digits, terms,
                             spectral_levels_[at])) {
            return false;
        }
    }
    return true;
}

}  // namespace drude
