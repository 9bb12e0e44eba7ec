# One static library per folder of src/. A folder sees the headers of the folders it depends on and
# of no other: each library exports only a directory that holds a link to its own folder.

include(GNUInstallDirs)

add_library(meshgraft_options INTERFACE)
set_target_properties(meshgraft_options PROPERTIES EXPORT_NAME options)
install(TARGETS meshgraft_options EXPORT meshgraft-targets)
target_compile_options(meshgraft_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
  -ffp-contract=off)  # fused operations would make results depend on the machine
if(MESHGRAFT_SANITIZE)
  target_compile_options(meshgraft_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer -Wno-maybe-uninitialized)  # instrumented, g++ 12 finds such uses in <functional>
  target_link_options(meshgraft_options INTERFACE -fsanitize=address,undefined)
endif()

# meshgraft_module(folder SOURCES a.cpp ... DEPENDS folder ... LIBRARIES target ...)
# SOURCES are relative to the folder; DEPENDS and LIBRARIES are visible to users of the folder too.
function(meshgraft_module folder)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE" ${ARGN})
  set(arrows ${PROJECT_BINARY_DIR}/arrows/${folder})
  file(MAKE_DIRECTORY ${arrows})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${folder} ${arrows}/${folder} SYMBOLIC)
  add_library(meshgraft_${folder} STATIC ${arg_SOURCES})
  target_include_directories(meshgraft_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${arrows}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM arg_DEPENDS PREPEND meshgraft_)
  target_link_libraries(meshgraft_${folder} PUBLIC ${arg_DEPENDS} ${arg_LIBRARIES}
    PRIVATE meshgraft_options ${arg_PRIVATE})
  set_target_properties(meshgraft_${folder} PROPERTIES EXPORT_NAME ${folder})
  install(TARGETS meshgraft_${folder} EXPORT meshgraft-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# meshgraft_test(name SOURCES a.cpp ... DEPENDS folder ...): one program of GoogleTest tests. Under ctest, laws see
# the same scenes in every run: a red test means that the change broke something. `make soak` looks for new scenes.
set(MESHGRAFT_LAW_SEED 20261129 CACHE STRING "Seed of the generated scenes of laws under ctest")
function(meshgraft_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  list(TRANSFORM arg_DEPENDS PREPEND meshgraft_)
  target_link_libraries(${name} PRIVATE meshgraft_options ${arg_DEPENDS} ${arg_LIBRARIES} GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ENVIRONMENT RC_PARAMS=seed=${MESHGRAFT_LAW_SEED})
endfunction()
