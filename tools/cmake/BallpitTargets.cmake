# What every target shares: warnings, exact arithmetic, include paths, sanitizers.

add_library(warnings INTERFACE)
set(cxx_warnings -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
                 -Wno-missing-field-initializers)
target_compile_options(warnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:${cxx_warnings}>
    # g++ 12 sees a fault in "text" + std::string where there is none (its bug 105651).
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>
    # Through nvcc, g++ 13 sees another one in std::sort.
    "$<$<AND:$<COMPILE_LANGUAGE:CUDA>,$<CXX_COMPILER_ID:GNU>>:SHELL:-Xcompiler=-Wno-restrict,-Wno-array-bounds>"
    # -Wpedantic complains about the code that nvcc hands to the host compiler.
    "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Xcompiler=-Wall,-Wextra,-Wno-missing-field-initializers>")

# Ours must compile without a warning. A student's half-written file need not.
add_library(warnings_are_errors INTERFACE)
target_compile_options(warnings_are_errors INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Werror>
    "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Xcompiler=-Werror -Werror=all-warnings>")
add_library(half_written INTERFACE)
set(unused -Wno-unused-parameter -Wno-unused-variable -Wno-unused-function
           -Wno-unused-but-set-variable)
string(REPLACE ";" "," unused_for_nvcc "${unused}")
target_compile_options(half_written INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:${unused}>
    "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Xcompiler=${unused_for_nvcc} -diag-suppress=177,550>")

# Exactness: the same bits on CPU and GPU. No fused multiply-add anywhere, never fast-math.
add_library(exact_math INTERFACE)
if(BALLPIT_EXACT)
    target_compile_options(exact_math INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>
        "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:--fmad=false -Xcompiler=-ffp-contract=off>")
else()
    target_compile_definitions(exact_math INTERFACE BALLPIT_INEXACT)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # floorf and friends as one instruction: any processor since 2009. No FMA in this set.
    target_compile_options(exact_math INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:-msse4.2>
        "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Xcompiler=-msse4.2>")
endif()

add_library(sanitizers INTERFACE)
if(BALLPIT_SANITIZE)
    target_compile_options(sanitizers INTERFACE -fsanitize=address,undefined
                                                -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(sanitizers INTERFACE -fsanitize=address,undefined)
endif()

find_package(OpenMP COMPONENTS CXX)
if(NOT OpenMP_CXX_FOUND)
    message(STATUS "OpenMP: not found; the CPU runs on one thread")
endif()

# Gives a target the house rules. CHECKED: arrays test every index. STUDENT: a half-written file may
# warn. Where pieces are looked up ("05_cell_bounds/cell_bounds.cuh"): in solutions/; a student's
# build puts a folder of its own before it (BallpitChapters).
function(ballpit_target target)
    cmake_parse_arguments(PARSE_ARGV 1 rule "CHECKED;STUDENT" "" "")
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}
                                                ${PROJECT_SOURCE_DIR}/solutions)
    target_link_libraries(${target} PUBLIC warnings exact_math sanitizers)
    target_link_libraries(${target} PRIVATE
                          $<IF:$<BOOL:${rule_STUDENT}>,half_written,warnings_are_errors>)
    target_compile_definitions(${target} PUBLIC
                               $<$<OR:$<BOOL:${rule_CHECKED}>,$<CONFIG:Debug>>:BALLPIT_CHECKED>)
    if(OpenMP_CXX_FOUND)
        target_compile_options(${target} PUBLIC
            $<$<COMPILE_LANGUAGE:CXX>:${OpenMP_CXX_FLAGS}>
            "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Xcompiler=-fopenmp>")
        target_link_libraries(${target} PUBLIC ${OpenMP_CXX_LIBRARIES})
    else()
        target_compile_options(${target} PUBLIC $<$<COMPILE_LANGUAGE:CXX>:-Wno-unknown-pragmas>)
    endif()
    if(BALLPIT_WITH_CUDA)
        target_compile_definitions(${target} PUBLIC BALLPIT_CUDA)
        target_compile_options(${target} PUBLIC
            "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:--extended-lambda --expt-relaxed-constexpr>")
        target_link_libraries(${target} PUBLIC CUDA::cudart_static)
    else()
        get_target_property(sources ${target} SOURCES)
        list(FILTER sources INCLUDE REGEX "\\.cu$")
        if(sources)
            set_source_files_properties(${sources} PROPERTIES LANGUAGE CXX)
        endif()
    endif()
endfunction()
