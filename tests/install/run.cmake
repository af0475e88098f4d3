# Installs ${BUILD} into a prefix of its own, builds the project ${CONSUMER} against it with nothing
# but that prefix known, and runs what comes out.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "'${ARGN}' ended with ${status}")
  endif()
endfunction()

set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/copper)

# The program is installed whole: it answers, and its manual page, completion and udev rules are in
# place.
run(${prefix}/bin/drude --version)
foreach(file share/man/man1/drude.1 share/bash-completion/completions/drude
        lib/udev/rules.d/70-drude.rules)
  file(SIZE ${prefix}/${file} size)
  if(size LESS 500)
    message(FATAL_ERROR "${prefix}/${file}: found ${size} bytes, expected a whole page")
  endif()
endforeach()
