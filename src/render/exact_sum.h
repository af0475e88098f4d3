// Sums of doubles that have the same bits in whatever order and groups their terms are added.
//
// A term is cut into digits of base 2^16, nearest first, each a pure function of the term alone
// (Demmel & Nguyen 2015, IEEE Trans. Comput. 64(7), "Parallel Reproducible Summation"): digits of
// one weight add up exactly in an integer. A sum keeps the three digit sums from the weight of its
// largest term downwards. A larger term moves this window up; what falls out below it would have
// fallen out whenever the larger term had come, so that the digits kept are those of all terms.
// Nothing saturates: the window goes as far as a float32 and its square, and further. What is lost
// of a term is at most 2^-32 of the largest term (2^-31 of the largest square).
//
// Three int32 hold a sum of at most `most_terms` terms: a digit is at most 2^15 in magnitude.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace drude {

inline constexpr int sum_digits = 3;
inline constexpr uint32_t most_terms = 65535;

// Terms of one window level f are below 2^(8f - 1) in magnitude, so that they fit under the digit
// of weight 2^(16(ceil(f/2) - 1)), and their squares under the one of weight 2^(16(f - 1)).
inline constexpr int lowest_level = -60, highest_level = 64;

// The level for a largest magnitude, which must be below 2^(8 highest_level - 1); what is smaller
// than any level holds has the lowest.
inline int window_level(double magnitude) {
    int exponent = 0;
    if (!(magnitude > 0)) return lowest_level;
    std::frexp(magnitude, &exponent);  // magnitude < 2^exponent
    const int level = (exponent + 8) >> 3;
    return level < lowest_level ? lowest_level : level;
}

// The weight index of the leading digit of terms of a level, and of their squares.
inline int leading_digit(int level) {
    return (level + 1) >> 1;
}
inline int leading_digit_of_squares(int level) {
    return level;
}

namespace exact_sum_detail {

// 2^exponent, for exponents of normal numbers.
inline double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<uint64_t>(1023 + exponent) << 52);
}

}  // namespace exact_sum_detail

// Adds the digits of `term` whose leading one has weight 2^(16(leading - 1)); |term| must be below
// half of 2^(16 leading).
inline void add_digits(double term, int leading, int32_t digits[sum_digits]) {
    using exact_sum_detail::power_of_two;
    for (int i = 0; i < sum_digits; ++i) {
        const int exponent = 16 * (leading - 1 - i);
        // All three operations are exact: powers of two, rounding to a whole number, and a
        // difference whose bits are among the term's own.
        const double digit = std::nearbyint(term * power_of_two(-exponent));
        term -= digit * power_of_two(exponent);
        digits[i] += static_cast<int32_t>(digit);
    }
}

// Moves the window up by `by` digits.
inline void raise_digits(int by, int32_t digits[sum_digits]) {
    for (int i = sum_digits - 1; by > 0 && i >= 0; --i) digits[i] = i >= by ? digits[i - by] : 0;
}

// The sum, rounded once to a double.
inline double sum_of_digits(int leading, const int32_t digits[sum_digits]) {
    // At most (2^31 - 2^15)(2^32 + 2^16 + 1) = 2^63 - 2^15.
    const int64_t whole = (static_cast<int64_t>(digits[0]) * 65536 + digits[1]) * 65536 + digits[2];
    return static_cast<double>(whole) * exact_sum_detail::power_of_two(16 * (leading - sum_digits));
}

}  // namespace drude
