# Writes ${OUTPUT}, which defines ${FUNCTION}(): every .${EXTENSION} of ${FOLDER} as a raw string
# under its name without extension.
#
# The contents never pass through a CMake list, where semicolons and brackets would be taken apart:
# each file is one quoted argument, appended to the output as it is read.
file(GLOB names RELATIVE "${FOLDER}" "${FOLDER}/*.${EXTENSION}")
list(LENGTH names count)
if(count EQUAL 0)
  message(FATAL_ERROR "${FOLDER}: found no .${EXTENSION} to compile in")
endif()
list(SORT names)

# The output appears under its name only when it is complete, so that an interrupted build starts
# over.
set(part "${OUTPUT}.part")
file(WRITE "${part}" "// Made by cmake/embed_tables.cmake.
#include \"materials/embedded_tables.h\"

namespace drude {

const std::vector<EmbeddedTable>& ${FUNCTION}() {
    static const std::vector<EmbeddedTable> tables = {
")
foreach(file IN LISTS names)
  get_filename_component(name "${file}" NAME_WLE)
  file(READ "${FOLDER}/${file}" content)
  string(FIND "${content}" ")TABLE\"" closing)
  string(LENGTH "${content}" length)
  # 65536 is what every compiler must take as one string literal.
  if(NOT closing EQUAL -1 OR length GREATER 65000)
    message(FATAL_ERROR "${FOLDER}/${file}: found ')TABLE\"' or more than 65000 characters, "
                        "which cannot be compiled in as one string")
  endif()
  file(APPEND "${part}" "        {\"${name}\", R\"TABLE(${content})TABLE\"},\n")
endforeach()
file(APPEND "${part}" "    };\n    return tables;\n}\n\n}  // namespace drude\n")
file(RENAME "${part}" "${OUTPUT}")
