# Writes what commit the sources are of to OUTPUT, and only where that has changed:
#   cmake -DSOURCE=FOLDER -DOUTPUT=FILE.cpp -P commit.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+changes --abbrev=10 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"#include \"bench/charts/machine.h\"

namespace drude {

const char* source_commit() {
    return \"@commit@\";
}

}  // namespace drude
")
