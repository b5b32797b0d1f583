# Rendering, the window and recording, where OpenGL, EGL, GLX, X11, GLU, GLEW, GLUT, FreeType and
# FFmpeg's libraries are installed. Sets BALLPIT_WITH_GRAPHICS.
set(BALLPIT_WITH_GRAPHICS OFF)
if(NOT BALLPIT_GRAPHICS STREQUAL "OFF")
    find_package(OpenGL COMPONENTS OpenGL EGL GLX)
    find_package(X11)
    find_package(GLEW)
    find_package(GLUT)
    find_package(Freetype)
    find_package(PkgConfig)
    if(PkgConfig_FOUND)
        pkg_check_modules(FFMPEG IMPORTED_TARGET libavcodec libavformat libavutil libswscale)
    endif()
    if(OpenGL_EGL_FOUND AND OpenGL_GLX_FOUND AND X11_FOUND AND OPENGL_GLU_FOUND AND GLEW_FOUND AND GLUT_FOUND AND FREETYPE_FOUND
       AND FFMPEG_FOUND)
        set(BALLPIT_WITH_GRAPHICS ON)
    elseif(BALLPIT_GRAPHICS STREQUAL "ON")
        message(FATAL_ERROR "Graphics were asked for, but a library is missing. Debian: apt-get "
                            "install libgl-dev libegl-dev libx11-dev libglu1-mesa-dev libglew-dev "
                            "freeglut3-dev libfreetype-dev libavcodec-dev libavformat-dev "
                            "libswscale-dev pkg-config")
    endif()
endif()

# ballpit_frame writes pictures. ballpit_gl holds what drawing needs and no chapter asks for.
# The studio is what draws and records: it holds pieces of chapters, so it is compiled with the
# solutions (ballpit_film), and with a student's files into the student's own programs.
if(BALLPIT_WITH_GRAPHICS)
    message(STATUS "Graphics: yes")
    add_library(ballpit_frame STATIC common/frame.cpp common/video_player.cpp)
    target_link_libraries(ballpit_frame PUBLIC PkgConfig::FFMPEG)
    add_library(ballpit_gl STATIC
        common/camera.cpp common/display_loss.cpp common/offscreen_context.cpp common/opengl.cpp
        common/shared_vertices.cu common/text.cpp)
    target_link_libraries(ballpit_gl
        PUBLIC ballpit_frame OpenGL::OpenGL OpenGL::EGL OpenGL::GLX OpenGL::GLU X11::X11 GLEW::GLEW
               GLUT::GLUT Freetype::Freetype)
    ballpit_target(ballpit_gl)
    set(studio_sources
        common/film.cpp
        common/shot.cpp
        common/film_of_bodies.cu
        solutions/08_sphere_rendering/ball_shapes.cpp
        solutions/08_sphere_rendering/opengl_program.cpp
        solutions/08_sphere_rendering/sphere_renderer.cpp
        solutions/08_sphere_rendering/stage.cpp
        solutions/09_video_recording/encoder_choice.cpp
        solutions/09_video_recording/stream_copy.cpp
        solutions/09_video_recording/video_file.cpp
        solutions/09_video_recording/video_recorder.cpp)
    set(viewer_sources
        solutions/10_full_system/opengl_visualizer.cpp
        solutions/10_full_system/viewer.cpp)
else()
    message(STATUS "Graphics: no (physics, tests of physics and the bench are built)")
    add_library(ballpit_frame STATIC common/frame_without_graphics.cpp)
    set(studio_sources common/film_without_graphics.cpp)
    set(viewer_sources solutions/10_full_system/viewer_without_graphics.cpp)
endif()
ballpit_target(ballpit_frame)
list(APPEND studio_sources common/show_spheres.cpp)
list(APPEND viewer_sources
    solutions/10_full_system/ledger.cpp
    solutions/10_full_system/user_recording.cpp)

# Compiles the studio into a target, with the pieces that this target sees. VIEWER: with the window
# and the ledger of the whole system.
function(ballpit_studio target)
    cmake_parse_arguments(PARSE_ARGV 1 studio "VIEWER" "" "")
    set(sources ${studio_sources})
    if(studio_VIEWER)
        list(APPEND sources ${viewer_sources})
        target_include_directories(${target} SYSTEM PRIVATE ${JSON_INCLUDE_DIR})
    endif()
    foreach(source ${sources})
        target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/${source})
    endforeach()
    target_link_libraries(${target} PUBLIC ballpit_common)
    if(BALLPIT_WITH_GRAPHICS)
        target_link_libraries(${target} PUBLIC ballpit_gl)
    endif()
endfunction()

add_library(ballpit_film STATIC)
ballpit_studio(ballpit_film)
ballpit_target(ballpit_film)

add_library(ballpit_viewer STATIC ${viewer_sources})
target_link_libraries(ballpit_viewer PUBLIC ballpit_film)
target_include_directories(ballpit_viewer SYSTEM PRIVATE ${JSON_INCLUDE_DIR})
ballpit_target(ballpit_viewer)
