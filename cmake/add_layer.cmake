# One static library per layer, with exactly the layers it may see (docs/architecture.md).
#   strataflow_add_layer(name SOURCES a.cpp … LAYERS base model … PRIVATE third::party …)
function(strataflow_add_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LAYERS;PRIVATE" ${ARGN})
  set(target strataflow_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/strataflow>)
  foreach(layer IN LISTS ARG_LAYERS)
    target_link_libraries(${target} PUBLIC strataflow_${layer})
  endforeach()
  target_link_libraries(${target} PUBLIC $<BUILD_INTERFACE:strataflow_floating_point> $<BUILD_INTERFACE:strataflow_sanitizers>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:strataflow_warnings> ${ARG_PRIVATE})
endfunction()

# Headers nearly every test reads, parsed once for all test executables: half the cost of compiling a test is theirs.
function(strataflow_precompile_test_headers)
  add_library(strataflow_test_headers OBJECT ${PROJECT_SOURCE_DIR}/tests/support/precompiled_headers.cpp)
  target_link_libraries(strataflow_test_headers PRIVATE
    GTest::gtest_main GTest::gmock strataflow_floating_point strataflow_warnings strataflow_sanitizers)
  target_precompile_headers(strataflow_test_headers PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <cmath> <filesystem> <map> <optional> <set> <span> <string> <vector>)
  strataflow_compile_as_test(strataflow_test_headers)
  # As the executables that reuse them.
  set_target_properties(strataflow_test_headers PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(strataflow_test_headers PRIVATE -fPIE)
endfunction()

# Tests are compiled for their answer, not their speed; what they test keeps its own flags.
function(strataflow_compile_as_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# One GoogleTest executable per folder of tests/, labelled so that `ctest -L label` selects it.
#   strataflow_add_test(name SOURCES a_test.cpp … LAYERS … LABELS …)
function(strataflow_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LAYERS;PRIVATE;LABELS" ${ARGN})
  set(target ${name}_tests)
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  foreach(layer IN LISTS ARG_LAYERS)
    target_link_libraries(${target} PRIVATE strataflow_${layer})
  endforeach()
  target_link_libraries(${target} PRIVATE GTest::gtest_main GTest::gmock strataflow_warnings strataflow_sanitizers ${ARG_PRIVATE})
  strataflow_compile_as_test(${target})
  target_precompile_headers(${target} REUSE_FROM strataflow_test_headers)
  target_compile_definitions(${target} PRIVATE
    STRATAFLOW_SOURCE_DIR="${PROJECT_SOURCE_DIR}" STRATAFLOW_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 TEST_LIST ${target}_names
    PROPERTIES TIMEOUT 600)
  # A list of labels does not survive gtest_discover_tests: labels are set once the tests are known.
  set(environment "")
  if(STRATAFLOW_SANITIZE MATCHES "thread")
    set(environment "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/tsan_suppressions.txt history_size=7")
  endif()
  set(properties ${CMAKE_CURRENT_BINARY_DIR}/${target}_properties.cmake)
  file(WRITE ${properties}
    "foreach(test IN LISTS ${target}_names)\n"
    "  set_tests_properties(\${test} PROPERTIES LABELS \"${name};${ARG_LABELS}\" ENVIRONMENT \"${environment}\")\n"
    "endforeach()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${properties})
endfunction()
