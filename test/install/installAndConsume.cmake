# Run with cmake -P by the test "install"; any failing step ends it with an error.
foreach(variable IN ITEMS BUILD_FOLDER WORK_FOLDER CONSUMER EXAMPLES COMPONENTS EXAMPLE_NAMES CXX_COMPILER MPIEXEC)
  if(NOT ${variable})
    message(FATAL_ERROR "${variable} is not set")
  endif()
endforeach()

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed with '${result}'")
  endif()
endfunction()

# Nothing may be left of an earlier run: a header no longer installed would go unnoticed.
file(REMOVE_RECURSE ${WORK_FOLDER})
set(prefix ${WORK_FOLDER}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${WORK_FOLDER}/first_place)

# Relocatable: the package files name no place of their own, and the tree works where it was moved to.
file(GLOB package_files ${WORK_FOLDER}/first_place/*/cmake/Atrapos/*.cmake
  ${WORK_FOLDER}/first_place/*/*/cmake/Atrapos/*.cmake)
if(NOT package_files)
  message(FATAL_ERROR "no package files were installed")
endif()
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  foreach(place IN ITEMS ${WORK_FOLDER}/first_place ${BUILD_FOLDER})
    string(FIND "${text}" "${place}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${file} names ${place}")
    endif()
  endforeach()
endforeach()
file(RENAME ${WORK_FOLDER}/first_place ${prefix})

# No prefix of Trilinos is given: the installed package file knows its own. -O1: these programs compute little.
set(common -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${LAUNCHER}")  # a list, which no argument of execute_process may be

# One program per component. The list is written with commas: a semicolon would not survive execute_process.
set(build ${WORK_FOLDER}/consumer)
string(REPLACE ";" "," components "${COMPONENTS}")
run(${CMAKE_COMMAND} ${common} -S ${CONSUMER} -B ${build} -DCOMPONENTS=${components})
run(${CMAKE_COMMAND} --build ${build} --parallel 1)
foreach(component IN LISTS COMPONENTS)
  run(${CMAKE_COMMAND} -E chdir ${build} ${build}/${component})
endforeach()

# The library prints nothing, with one rank and with two.
foreach(launcher IN ITEMS "" "${MPIEXEC};--oversubscribe;-np;2")
  execute_process(COMMAND ${launcher} ${build}/independent RESULT_VARIABLE result OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR NOT output STREQUAL "")
    message(FATAL_ERROR "independent ended with '${result}' and said:\n${output}")
  endif()
endforeach()

# taylor alone: nothing of MPI, Tpetra or MUMPS is looked for, and no other package's target exists.
run(${CMAKE_COMMAND} ${common} -S ${CONSUMER} -B ${WORK_FOLDER}/taylor -DCOMPONENTS=taylor
  -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON -DCMAKE_DISABLE_FIND_PACKAGE_Tpetra=ON -DABSENT=linear,path,fem)
run(${CMAKE_COMMAND} --build ${WORK_FOLDER}/taylor --parallel 1)
run(${WORK_FOLDER}/taylor/taylor)

# What is not there is refused by name, and so is another minor version.
function(refused text)
  execute_process(COMMAND ${CMAKE_COMMAND} ${common} -S ${CONSUMER} -B ${WORK_FOLDER}/refused ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  file(REMOVE_RECURSE ${WORK_FOLDER}/refused)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(result EQUAL 0 OR NOT output MATCHES "${text}")
    message(FATAL_ERROR "expected a refusal with '${text}':\n${output}")
  endif()
endfunction()
refused("this Atrapos has no component 'plasma', only taylor" -DCOMPONENTS=taylor,plasma)
refused("compatible with requested version \"0.9\"" -DCOMPONENTS=taylor -DVERSION=0.9)

# The promise of a short glue: lines of code of the only file that knows both sides.
file(READ ${EXAMPLES}/own_loop/PathGlue.hpp glue)
string(REGEX REPLACE "[][;]" "" glue "${glue}")  # special in lists
string(REGEX REPLACE "\n *(//|#)[^\n]*" "" glue "\n${glue}")
string(REGEX REPLACE "\n[ \n]*" "\n" glue "${glue}")
string(REGEX MATCHALL "\n[^\n]" glue "${glue}")
list(LENGTH glue lines)
if(lines GREATER_EQUAL 30 OR lines LESS 20)
  message(FATAL_ERROR "PathGlue.hpp has ${lines} lines of code, promised are less than 30")
endif()

# The examples, each a project of its own; what has several ranks in it gives the same with two.
foreach(example IN LISTS EXAMPLE_NAMES)
  run(${CMAKE_COMMAND} ${common} -S ${EXAMPLES}/${example} -B ${WORK_FOLDER}/${example})
  run(${CMAKE_COMMAND} --build ${WORK_FOLDER}/${example} --parallel 1)
  run(${WORK_FOLDER}/${example}/${example})
endforeach()
run(${MPIEXEC} --oversubscribe -np 2 ${WORK_FOLDER}/own_loop/own_loop)

# A plug-in for decks, by the installed command: the deck alone is refused, with the library its film is an arc.
set(plugin ${WORK_FOLDER}/plugin)
run(${CMAKE_COMMAND} ${common} -S ${EXAMPLES}/plugin -B ${plugin})
run(${CMAKE_COMMAND} --build ${plugin} --parallel 1)
configure_file(${EXAMPLES}/plugin/film.yaml ${plugin}/film.yaml COPYONLY)
set(atrapos ${CMAKE_COMMAND} -E chdir ${plugin} ${prefix}/bin/atrapos)
run(${atrapos} mesh -q film.yaml)
execute_process(COMMAND ${atrapos} run -q film.yaml RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 2 OR NOT error MATCHES "needs the plug-in 'soap'.*--plugin FILE")
  message(FATAL_ERROR "a deck without its plug-in ended with '${result}' and said: ${error}")
endif()
run(${atrapos} run -q film.yaml --plugin soap.so)
file(STRINGS ${plugin}/film_results/path.csv rows)
list(GET rows -1 last)
# At 1.5 the middle is 2/3 - sqrt(4/9 - 1/4) = 0.225708 high.
if(NOT last MATCHES "^1,[^,]*,1.5,0.2257")
  message(FATAL_ERROR "the film is not an arc: ${last}")
endif()
