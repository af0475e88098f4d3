// Choosing from a discrete distribution by one uniform number, in the order of its entries, so that
// well-distributed numbers stay well distributed (an alias table would tear them apart).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/huge_pages.h"

namespace drude {

// Rows of cumulative sums, all of one length. What such a table of millions of entries costs is its
// cache misses; so a row is a tree of nodes of 16 sums, each a cache line and one comparison of
// vectors, of which only the last level is too large for the caches.
class CumulativeRows {
  public:
    CumulativeRows() = default;
    // `sums`: rows * length cumulative sums, ascending within a row, from weights of 0 or more, the
    // last of each row above 0.
    CumulativeRows(const std::vector<float>& sums, size_t length) : length_(length) {
        const size_t rows = sums.size() / length;
        const float* below = sums.data();
        for (size_t count = length, pitch = length; levels_.empty() || count > fanout;) {
            // Of the sums below, or of the last sums of the nodes below.
            const bool leaves = levels_.empty();
            Level level;
            level.entries = leaves ? count : (count + fanout - 1) / fanout;
            level.pitch = (level.entries + fanout - 1) / fanout * fanout;
            level.sums.assign(rows * level.pitch, std::numeric_limits<float>::infinity());
            for (size_t row = 0; row < rows; ++row) {
                for (size_t i = 0; i < level.entries; ++i) {
                    const size_t from = leaves ? i : std::min((i + 1) * fanout, count) - 1;
                    level.sums[row * level.pitch + i] = below[row * pitch + from];
                }
            }
            count = level.entries;
            pitch = level.pitch;
            levels_.push_back(std::move(level));
            below = levels_.back().sums.data();
        }
    }

    // The entry i with sum[i-1] <= u * total < sum[i], u in [0, 1), and where between.
    size_t find(size_t row, float u, float* inside) const {
        const float* sum = &levels_.front().sums[row * levels_.front().pitch];
        const Level& top = levels_.back();
        const float total = top.sums[row * top.pitch + top.entries - 1];
        const float target = u * total;
        size_t i = 0;
        if (target < total) {
            // A node's last sum is its parent's, which exceeds the target: before < fanout.
            for (size_t level = levels_.size(); level-- > 0;) {
                const float* node = &levels_[level].sums[row * levels_[level].pitch + i * fanout];
                size_t before = 0;
                for (size_t k = 0; k < fanout; ++k) before += node[k] <= target;
                i = i * fanout + before;
            }
        } else {  // by rounding: the last entry that has some width
            for (i = length_ - 1; i > 0 && sum[i] == sum[i - 1];) --i;
        }
        const float low = i > 0 ? sum[i - 1] : 0;
        *inside = std::clamp((target - low) / (sum[i] - low), 0.0f, 0x1.fffffep-1f);
        return i;
    }

  private:
    static constexpr size_t fanout = 16;
    struct Level {
        size_t entries = 0;  // a row
        size_t pitch = 0;    // a multiple of the fanout; what is beyond the entries is infinite
        HugePageVector<float> sums;
    };
    size_t length_ = 0;
    std::vector<Level> levels_;  // the leaves first
};

}  // namespace drude
