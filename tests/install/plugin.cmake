# Installs ${BUILD} into a prefix of its own, builds examples/tabulated-pbrdf against it, and draws
# rough copper from its table: like the built-in conductor, and the same on any number of threads.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "'${ARGN}' ended with ${status}")
  endif()
endfunction()
# Ends with `expected` and says `part` on stderr.
function(run_refused expected part)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status ERROR_VARIABLE said)
  string(FIND "${said}" "${part}" found)
  if(NOT status EQUAL ${expected} OR found LESS 0)
    message(FATAL_ERROR "'${ARGN}' ended with ${status}, expected ${expected} and '${part}': ${said}")
  endif()
endfunction()

set(prefix ${WORK}/prefix)
set(drude ${prefix}/bin/drude)
set(example ${SOURCE}/examples/tabulated-pbrdf)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/scene)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${example} -B ${WORK}/build -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/build)

execute_process(COMMAND ${WORK}/build/copper_table 0.4 OUTPUT_FILE ${WORK}/scene/copper.pbrdf
                COMMAND_ERROR_IS_FATAL ANY)
file(COPY ${example}/sphere.pbrt DESTINATION ${WORK}/scene)
file(READ ${example}/sphere.pbrt scene)
string(REPLACE [["tabulated_pbrdf" "string table" "copper.pbrdf"]]
  [["conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k" "float roughness" 0.4
    "bool remaproughness" false]] built_in "${scene}")
file(WRITE ${WORK}/scene/built-in.pbrt "${built_in}")

run_refused(2 "\"tabulated_pbrdf\" is not known" ${drude} render ${WORK}/scene/sphere.pbrt
            -o ${WORK}/none.exr)
set(ENV{DRUDE_PLUGIN_PATH} ${WORK}/build)
foreach(threads 1 2)
  run(${drude} render ${WORK}/scene/sphere.pbrt -o ${WORK}/${threads}.exr --transport stokes
      --spp 256 --threads ${threads} --quiet)
endforeach()
run(${drude} compare ${WORK}/1.exr ${WORK}/2.exr --exact)

# Linear interpolation over 2.5 degrees of a lobe of alpha 0.4 is within 1 %, and noise adds to it.
run(${drude} render ${WORK}/scene/built-in.pbrt -o ${WORK}/built-in.exr --transport stokes
    --spp 256 --quiet)
run(${drude} compare ${WORK}/1.exr ${WORK}/built-in.exr --any-scene --tolerance 0.02,0.02,1)
run(${drude} compare ${WORK}/1.exr ${WORK}/built-in.exr --any-scene --channels S1,S2
    --tolerance 0.004,0.02,1)
# What that test would let pass must not be everything.
run_refused(1 "" ${drude} compare ${WORK}/1.exr ${WORK}/built-in.exr --any-scene
            --tolerance 0.0005,0.0005,1)

# Elements that change their sign with phi_d: a mirrored world with mirrored coordinates gives the
# same picture, and only then.
file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/sideways.pbrdf ${WORK}/scene/copper.pbrdf)
string(REPLACE "LookAt" "Scale -1 1 1\nLookAt" mirrored "${scene}")
string(REPLACE "[ -2 3 -3 ]" "[ 2 3 -3 ]" mirrored "${mirrored}")
file(WRITE ${WORK}/scene/mirrored.pbrt "${mirrored}")
foreach(hand sphere mirrored)
  run(${drude} render ${WORK}/scene/${hand}.pbrt -o ${WORK}/${hand}.exr --transport stokes
      --spp 256 --quiet)
endforeach()
run(${drude} compare ${WORK}/sphere.exr ${WORK}/mirrored.exr --any-scene)

# A table that breaks off is an error with file and line, at the scene's own line.
file(WRITE ${WORK}/scene/copper.pbrdf "pbrdf-table 1\nwavelengths_nm 2 400 x")
run_refused(2 "copper.pbrdf:2: expected a finite number" ${drude} render
            ${WORK}/scene/sphere.pbrt -o ${WORK}/none.exr)
