# burin_add_test(NAME SOURCES … LIBRARIES … [LABELS …] [TIMEOUT seconds] [ALONE]): a GoogleTest program,
# one CTest entry per program (start-up dominates; run one case with --gtest_filter).
#
# Where BURIN_UNITY is on, the tests of a folder share a few programs, unless they say ALONE or are for the
# thread sanitizer; the CTest entries stay (burin_test_program). $<TARGET_FILE:NAME> is then nothing:
# burin_test_command says what runs a test.
#
# Label "sanitize" puts a test into the subset that runs under address and undefined-behaviour
# sanitizers, "threads" into the one for the thread sanitizer; targets sanitize_tests and
# threads_tests build exactly those programs.
function(burin_add_test name)
  cmake_parse_arguments(arg "ALONE" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  burin_test_program(${name} SOURCES ${arg_SOURCES} LABELS ${arg_LABELS} ALONE ${arg_ALONE}
                     KIND serial LIBRARIES ${arg_LIBRARIES} burin::test_main)
  burin_test_command(command ${name})
  add_test(NAME ${name} COMMAND ${command})
  burin_set_test(${name} TIMEOUT ${arg_TIMEOUT} LABELS ${arg_LABELS})
endfunction()

# burin_add_mpi_test(NAME RANKS 1 2 3 … SOURCES … LIBRARIES … [LABELS …] [TIMEOUT seconds]
# [PROCESSORS n] [ALONE]): a GoogleTest program with the MPI main of tests/support, one CTest entry per rank
# count. Every rank runs every case; a failure on any rank fails the entry. Several ranks count as two
# processors (or n, for a test that mostly waits), so that a machine with two cores runs one such test at
# a time; one rank, though it may draw with more threads, as one, because no test keeps them busy.
# The sanitizers run it on up to three ranks: with three there are a rank in the middle and folding.
function(burin_add_mpi_test name)
  cmake_parse_arguments(arg "ALONE" "TIMEOUT;PROCESSORS" "RANKS;SOURCES;LIBRARIES;LABELS" PROCESSORS 2 ${ARGN})
  burin_test_program(${name} SOURCES ${arg_SOURCES} LABELS ${arg_LABELS} ALONE ${arg_ALONE}
                     KIND mpi LIBRARIES ${arg_LIBRARIES} burin::test_mpi_main)
  burin_test_command(command ${name})
  foreach(ranks ${arg_RANKS})
    add_test(NAME ${name}_${ranks} COMMAND ${BURIN_MPIRUN} -n ${ranks} ${command})
    set(processors ${arg_PROCESSORS})
    if(ranks EQUAL 1)
      set(processors 1)
    endif()
    set(labels ${arg_LABELS})
    if(ranks GREATER 3)
      list(REMOVE_ITEM labels sanitize)
    endif()
    burin_set_test(${name}_${ranks} TIMEOUT ${arg_TIMEOUT} PROCESSORS ${processors}
                   LABELS ${labels} mpi)
  endforeach()
endfunction()

# What both kinds of test programs have in common. KIND: serial or mpi; ALONE: TRUE or FALSE.
function(burin_test_program name)
  cmake_parse_arguments(arg "" "KIND;ALONE" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  set(program ${name})
  if(NOT BURIN_UNITY OR arg_ALONE OR "threads" IN_LIST arg_LABELS)
    burin_test_executable(${name})
    target_sources(${name} PRIVATE ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES})
  else()
    set(subset others)
    if("sanitize" IN_LIST arg_LABELS)
      set(subset sanitize)
    endif()
    get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
    set(program ${folder}_${arg_KIND}_${subset})
    # Never built: it holds what the folder says of this test until the program takes it over.
    add_library(${name} OBJECT EXCLUDE_FROM_ALL ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES})
    if(NOT TARGET ${program})
      burin_test_executable(${program})
      set_target_properties(${program} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    endif()
    cmake_language(EVAL CODE "cmake_language(DEFER CALL burin_join ${program} ${name})")
    set_target_properties(${name} PROPERTIES BURIN_PROGRAM ${program})
  endif()
  foreach(subset sanitize threads)
    if(subset IN_LIST arg_LABELS)
      add_dependencies(${subset}_tests ${program})
    endif()
  endforeach()
endfunction()

function(burin_test_executable name)
  add_executable(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE
    burin::test_support GTest::gtest GTest::gmock burin_warnings)
  target_link_options(${name} PRIVATE ${BURIN_TEST_LINKER})
  burin_use_headers(${name} burin_test_headers)
  burin_test_options(${name})
endfunction()

# Called when a folder has said everything of its tests: PROGRAM takes over what TEST is made of. Headers
# and the templates of scenes are most of what a test compiles; together, tests take a third of the time
# that they take one by one.
function(burin_join program test)
  foreach(property SOURCES COMPILE_DEFINITIONS INCLUDE_DIRECTORIES LINK_LIBRARIES)
    get_target_property(values ${test} ${property})
    if(values)
      set_property(TARGET ${program} APPEND PROPERTY ${property} ${values})
    endif()
  endforeach()
  get_target_property(dependencies ${test} MANUALLY_ADDED_DEPENDENCIES)
  if(dependencies)
    add_dependencies(${program} ${dependencies})
  endif()
endfunction()

# burin_test_command(VARIABLE NAME): what runs the test NAME, without mpirun; of a shared program, the cases
# of the files that the test is made of.
function(burin_test_command variable name)
  get_target_property(program ${name} BURIN_PROGRAM)
  if(program)
    set(command $<TARGET_FILE:${program}> "--files=$<JOIN:$<TARGET_PROPERTY:${name},SOURCES>,:>")
  else()
    set(command $<TARGET_FILE:${name}>)
  endif()
  set(${variable} ${command} PARENT_SCOPE)
endfunction()

# burin_set_test(NAME [TIMEOUT seconds] [PROCESSORS n] [LABELS …]): what every CTest entry needs:
# a time-out (60 seconds if none is given) and the environment. Those that may take longest begin first,
# lest one of them be alone at the end.
function(burin_set_test name)
  cmake_parse_arguments(arg "" "TIMEOUT;PROCESSORS" "LABELS" TIMEOUT 60 PROCESSORS 1 ${ARGN})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} COST ${arg_TIMEOUT}
    PROCESSORS ${arg_PROCESSORS} LABELS "${arg_LABELS}" ENVIRONMENT "${BURIN_TEST_ENVIRONMENT}")
endfunction()

# Tests are compiled in less time rather than run in less: what they test has its full optimisation.
# With the address sanitizer they are not optimised at all: two fifths less to compile, and no check is
# optimised away.
set(BURIN_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
if(BURIN_SANITIZE MATCHES "address")
  set(BURIN_TEST_OPTIONS -O0 ${BURIN_CHECKS_AS_CALLS})
endif()
function(burin_test_options target)
  target_compile_options(${target} PRIVATE ${BURIN_TEST_OPTIONS})
endfunction()

# There are a hundred of them to link, which gold does in a quarter of the time.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold BURIN_HAS_GOLD)
set(BURIN_TEST_LINKER $<$<BOOL:${BURIN_HAS_GOLD}>:-fuse-ld=gold>)

# The tests' precompiled headers. A program, since those are compiled with other options than
# libraries.
add_executable(burin_test_headers ${CMAKE_CURRENT_LIST_DIR}/test_headers.cpp)
target_link_libraries(burin_test_headers PRIVATE fmt::fmt glm::glm GTest::gmock burin_warnings)
burin_test_options(burin_test_headers)
burin_headers(burin_test_headers ${BURIN_COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)

add_custom_target(sanitize_tests)
add_custom_target(threads_tests)

# More ranks than cores, none of them bound to one; and for containers: root allowed, no reading of
# another process's memory, no complaints where /sys is missing.
set(BURIN_MPIRUN ${MPIEXEC_EXECUTABLE} -q --oversubscribe --bind-to none
    --mca btl_vader_single_copy_mechanism none)
set(BURIN_TEST_DATA ${CMAKE_SOURCE_DIR}/../shared/data CACHE PATH
    "Folder of real volumes for the tests that want some; they skip where it is absent")
set(BURIN_TEST_ENVIRONMENT
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 HWLOC_HIDE_ERRORS=2
    BURIN_TEST_DATA=${BURIN_TEST_DATA})
if(BURIN_SANITIZE)
  list(APPEND BURIN_TEST_ENVIRONMENT
    LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/support/lsan.supp:print_suppressions=0
    UBSAN_OPTIONS=print_stacktrace=1)
endif()
