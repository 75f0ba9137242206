# Run with cmake -P by the test "install"; any failing step ends it with an error.
foreach(variable IN ITEMS BUILD_FOLDER WORK_FOLDER CONSUMER COMPONENTS CXX_COMPILER)
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
set(build ${WORK_FOLDER}/build)
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${prefix})

# No prefix of Trilinos is given: the installed package file knows its own. The list is written with
# commas since a semicolon would not survive execute_process.
string(REPLACE ";" "," components "${COMPONENTS}")
run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${build} -DCMAKE_PREFIX_PATH=${prefix} -DCOMPONENTS=${components}
  -DCMAKE_CXX_COMPILER=${CXX_COMPILER} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${build} --parallel 1)
foreach(component IN LISTS COMPONENTS)
  run(${CMAKE_COMMAND} -E chdir ${build} ${build}/${component})
endforeach()
