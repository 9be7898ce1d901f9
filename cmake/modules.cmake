# SPDX-License-Identifier: Apache-2.0
include(GoogleTest)

set(SCONCE_TEST_DATA_DEFAULT ${CMAKE_CURRENT_SOURCE_DIR}/../shared/data)

# add_sconce_test(name source...): a GoogleTest program. Tests find the shared data by SCONCE_TEST_DATA.
function(add_sconce_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    SCONCE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" SCONCE_TEST_DATA_DEFAULT="${SCONCE_TEST_DATA_DEFAULT}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${ARG_LABEL}" TIMEOUT 600 SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
endfunction()

# One static library per module of src/LAYERS, linked by that list, and one test program from its *_test.cpp.
function(sconce_modules dir)
  file(STRINGS ${dir}/LAYERS lines REGEX "^[a-z]+:")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${dir}/LAYERS)
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([a-z]+):(.*)$" _ "${line}")
    set(module ${CMAKE_MATCH_1})
    separate_arguments(deps UNIX_COMMAND "${CMAKE_MATCH_2}")
    file(GLOB sources CONFIGURE_DEPENDS ${dir}/${module}/*.cpp)
    set(tests ${sources})
    list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
    list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
    list(TRANSFORM deps PREPEND sconce_)
    if(sources)
      add_library(sconce_${module} STATIC ${sources})
      target_include_directories(sconce_${module} PUBLIC ${dir})
      target_link_libraries(sconce_${module} PUBLIC ${deps} ${EXTERNAL_${module}})
    else()
      add_library(sconce_${module} INTERFACE)
      target_include_directories(sconce_${module} INTERFACE ${dir})
      target_link_libraries(sconce_${module} INTERFACE ${deps} ${EXTERNAL_${module}})
    endif()
    if(tests)
      add_sconce_test(${module}_test LABEL unit SOURCES ${tests} LIBS sconce_${module})
    endif()
  endforeach()
endfunction()
