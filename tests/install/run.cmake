# Installs a build into a stage of its own, then configures, builds and runs the project beside this file against it.
# Given: BUILD (a build tree), STAGE, GENERATOR; with SOURCE the build tree is made first, as a shared library without tools.
function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${STAGE})
if(SOURCE)
    run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${BUILD}
        -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DMANE_TOOLS=OFF -DMANE_TESTS=OFF)
    run(${CMAKE_COMMAND} --build ${BUILD})
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${STAGE}/prefix --component library)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR} -B ${STAGE}/build
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${STAGE}/prefix)
run(${CMAKE_COMMAND} --build ${STAGE}/build)
foreach(program uses_mane uses_mane_c)
    execute_process(COMMAND ${STAGE}/build/${program} WORKING_DIRECTORY ${STAGE} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
