# Rendering and recording, where OpenGL, EGL, GLEW and FFmpeg's libraries are installed.
# Sets BALLPIT_WITH_GRAPHICS.
set(BALLPIT_WITH_GRAPHICS OFF)
if(NOT BALLPIT_GRAPHICS STREQUAL "OFF")
    find_package(OpenGL COMPONENTS OpenGL EGL)
    find_package(GLEW)
    find_package(PkgConfig)
    if(PkgConfig_FOUND)
        pkg_check_modules(FFMPEG IMPORTED_TARGET libavcodec libavformat libavutil libswscale)
    endif()
    if(OpenGL_EGL_FOUND AND GLEW_FOUND AND FFMPEG_FOUND)
        set(BALLPIT_WITH_GRAPHICS ON)
    elseif(BALLPIT_GRAPHICS STREQUAL "ON")
        message(FATAL_ERROR "Graphics were asked for, but a library is missing. Debian: apt-get "
                            "install libgl-dev libegl-dev libglew-dev libavcodec-dev "
                            "libavformat-dev libswscale-dev pkg-config")
    endif()
endif()

if(BALLPIT_WITH_GRAPHICS)
    message(STATUS "Graphics: yes")
    add_library(ballpit_frame STATIC common/frame.cpp)
    target_link_libraries(ballpit_frame PUBLIC PkgConfig::FFMPEG)
    add_library(ballpit_graphics STATIC
        common/camera.cpp
        common/offscreen_context.cpp
        solutions/08_sphere_rendering/sphere_renderer.cpp
        solutions/09_video_recording/video_recorder.cpp)
    ballpit_target(ballpit_graphics)
    target_link_libraries(ballpit_graphics
        PUBLIC ballpit_common ballpit_frame OpenGL::OpenGL OpenGL::EGL GLEW::GLEW)
else()
    add_library(ballpit_frame STATIC common/frame_without_graphics.cpp)
    message(STATUS "Graphics: no (physics, tests of physics and the bench are built)")
endif()

# Picture files do not depend on anything else of ours.
ballpit_target(ballpit_frame)

# The film is there in every build; without graphics it refuses to record.
add_library(ballpit_film STATIC common/show_spheres.cpp)
if(BALLPIT_WITH_GRAPHICS)
    target_sources(ballpit_film PRIVATE common/film.cpp)
    target_link_libraries(ballpit_film PUBLIC ballpit_graphics)
else()
    target_sources(ballpit_film PRIVATE common/film_without_graphics.cpp)
endif()
ballpit_target(ballpit_film)
target_link_libraries(ballpit_film PUBLIC ballpit_common)
