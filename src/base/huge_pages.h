// Memory for tables of megabytes that are read at random: with pages of 4 kB nearly every read
// would miss the processor's table of pages as well as its caches.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace drude {

// Starts at a multiple of 64 bytes, from 2 MB on at one of 2 MB, where Linux is asked for huge
// pages; where it has none the memory is ordinary.
template <class T>
struct HugePageAllocator {
    using value_type = T;

    HugePageAllocator() = default;
    template <class U>
    HugePageAllocator(const HugePageAllocator<U>&) {}

    T* allocate(size_t count) {
        if (count > static_cast<size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
        const size_t page = count * sizeof(T) < huge ? 64 : huge;
        const size_t bytes = (count * sizeof(T) + page - 1) / page * page;
        void* memory = std::aligned_alloc(page, bytes);
        if (memory == nullptr) throw std::bad_alloc();
        if (page == huge) madvise(memory, bytes, MADV_HUGEPAGE);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, size_t) { std::free(memory); }

    template <class U>
    bool operator==(const HugePageAllocator<U>&) const {
        return true;
    }

  private:
    static constexpr size_t huge = size_t{1} << 21;
};

template <class T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace drude
