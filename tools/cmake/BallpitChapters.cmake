# The executables of a chapter: see docs/authoring.md, "A chapter's files".

add_library(ballpit_checks STATIC
    tests/checks/canvas.cpp tests/checks/check.cpp tests/checks/runner.cpp)
ballpit_target(ballpit_checks CHECKED)
target_link_libraries(ballpit_checks PUBLIC ballpit_core_checked ballpit_frame)
target_include_directories(ballpit_checks SYSTEM PRIVATE ${CLI11_INCLUDE_DIR} ${JSON_INCLUDE_DIR})

# Which of the student's pieces chapter `label` is built with: its own. One forwarding header a
# piece; `./ballpit check --mine` rewrites them.
function(ballpit_forward_pieces label)
    file(GLOB starters CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/chapters
         ${PROJECT_SOURCE_DIR}/chapters/*/*.cuh ${PROJECT_SOURCE_DIR}/chapters/*/*.h)
    foreach(piece ${starters})
        set(room solutions)
        if(piece MATCHES "^${label}_")
            set(room chapters)
        endif()
        set(header ${PROJECT_BINARY_DIR}/pieces/${label}/${piece})
        if(NOT EXISTS ${header})
            file(WRITE ${header} "#include \"${PROJECT_SOURCE_DIR}/${room}/${piece}\"\n")
        endif()
    endforeach()
endfunction()

# All checks of students' files, in one target: they hold every piece.
add_custom_target(starters)

# A target that looks for pieces in the folder of forwarding headers of chapter `label` first.
function(ballpit_student target label)
    ballpit_target(${target} STUDENT ${ARGN})
    target_include_directories(${target} BEFORE PRIVATE ${PROJECT_BINARY_DIR}/pieces/${label})
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
endfunction()

# NN_name and check_NN from the student's piece, and both again from the solution. STUDIO: the piece
# is a part of the studio, so the student's programs and both checks get a studio of their own.
# GRAPHICS: a build without graphics leaves the chapter out, and says so in the file left_out.
# PRODUCT name: the solution's program is called so, NN_name_reference is another name for it, and
# both programs have the window as well, the student's with the student's own studio.
# LIBRARIES names: what both programs need besides. SOURCES files: those of the libraries that use the
# piece; the student's program compiles them itself, with the student's piece.
file(WRITE ${PROJECT_BINARY_DIR}/left_out "")
function(ballpit_chapter folder)
    cmake_parse_arguments(PARSE_ARGV 1 chapter "STUDIO;GRAPHICS" "PRODUCT" "LIBRARIES;SOURCES")
    string(SUBSTRING ${folder} 0 2 label)
    if(chapter_GRAPHICS AND NOT BALLPIT_WITH_GRAPHICS)
        file(APPEND ${PROJECT_BINARY_DIR}/left_out "${label}\n")
        return()
    endif()
    ballpit_forward_pieces(${label})
    foreach(variant "" "_reference")
        set(main ${folder}${variant})
        set(check check_${label}${variant})
        if(variant AND chapter_PRODUCT)
            set(main ${chapter_PRODUCT})
        endif()
        add_executable(${main} chapters/${folder}/main.cu)
        add_executable(${check} tests/checks/check_${label}.cu)
        if(variant)
            ballpit_target(${main})
            ballpit_target(${check} CHECKED)
        else()
            ballpit_student(${main} ${label})
            ballpit_student(${check} ${label} CHECKED)
            add_dependencies(starters ${check})
        endif()
        target_link_libraries(${check} PRIVATE ballpit_checks)
        target_link_libraries(${main} PRIVATE ${chapter_LIBRARIES})
        if(NOT variant)
            target_sources(${main} PRIVATE ${chapter_SOURCES})
        endif()
        if(chapter_STUDIO)
            ballpit_studio(${check})
        endif()
        if(chapter_PRODUCT AND variant)
            target_link_libraries(${main} PRIVATE ballpit_viewer)
        elseif(chapter_PRODUCT)
            ballpit_studio(${main} VIEWER)
        elseif(chapter_STUDIO AND NOT variant)
            ballpit_studio(${main})
        else()
            target_link_libraries(${main} PRIVATE ballpit_film)
        endif()
    endforeach()
    if(chapter_PRODUCT)
        add_custom_target(${folder}_reference ALL
            ${CMAKE_COMMAND} -E create_symlink ${chapter_PRODUCT}
                             ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${folder}_reference
            DEPENDS ${chapter_PRODUCT})
    endif()
    if(BUILD_TESTING)
        # The solution passes its own checks; the student's are no test of ours.
        add_test(NAME ${check} COMMAND ${check})
        set_tests_properties(${check} PROPERTIES TIMEOUT 300)
    endif()
endfunction()
