# Installs into a folder of its own, builds the example against what is there, and runs it.
# cmake -D BUILD=... -D SOURCE=... -D WORK=... -P install_test.cmake

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/install/consumer -B ${WORK}/consumer -D CMAKE_PREFIX_PATH=${WORK}/prefix
  -D EXAMPLE=${SOURCE}/examples/graft.cpp)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)

set(caisson ${SOURCE}/data/caisson)
run(${WORK}/consumer/graft ${caisson}/base.unv ${caisson}/stiffener_a.unv ${WORK}/example.unv)
run(${WORK}/prefix/bin/meshgraft merge ${caisson}/base.unv ${caisson}/stiffener_a.unv -o ${WORK}/program.unv -q)
run(${CMAKE_COMMAND} -E compare_files ${WORK}/example.unv ${WORK}/program.unv)
