// A race made on purpose, in a body of the executor: under ThreadSanitizer the test of this program
// passes where the race is reported, so that silence of all other tests means something.
#include <cstdio>

#include "base/executor.h"

int main() {
    int unguarded = 0;
    // Long enough that both threads take part.
    drude::parallel_for(100'000, 2, [&](size_t) { ++unguarded; });
    std::printf("%d\n", unguarded);
    return 0;
}
