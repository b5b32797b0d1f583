// Chapter 09: colours by the standard's table, rows from the top, whole pictures against both.
#pragma once

#include "09_video_recording/frame_converter.h"
#include "tests/checks/check_09_frames.cuh"

namespace ballpit::check {

inline std::string text(Yuv c) {
    return "(" + text(c.y) + ", " + text(c.u) + ", " + text(c.v) + ")";
}
inline bool isNear(Yuv a, Yuv b, int tolerance) {
    return isNear(Color{a.y, a.u, a.v}, Color{b.y, b.u, b.v}, tolerance);
}

struct NamedColor {
    const char* name;
    Rgb rgb;
    Yuv yuv;
};
/// Colours and what BT.709 makes of them, worked out by hand.
inline const std::vector<NamedColor> namedColors{
    {"black", {0, 0, 0}, {16, 128, 128}},  {"white", {255, 255, 255}, {235, 128, 128}},
    {"red", {255, 0, 0}, {63, 102, 240}},  {"green", {0, 255, 0}, {173, 42, 26}},
    {"blue", {0, 0, 255}, {32, 240, 118}}, {"orange", {255, 128, 0}, {141, 59, 189}}};

/// The formula as matrix rows: y, u and v in their ranges.
inline Yuv rightYuv(Color c) {
    const auto round = [](double value) { return static_cast<int>(std::lround(value)); };
    return {round(16 + 0.182586 * c.r + 0.614231 * c.g + 0.062007 * c.b),
            round(128 - 0.100644 * c.r - 0.338572 * c.g + 0.439216 * c.b),
            round(128 + 0.439216 * c.r - 0.398942 * c.g - 0.040274 * c.b)};
}

inline void colorsByHand(Report& report) {
    std::vector<Yuv> got;
    for (const auto& [name, rgb, yuv] : namedColors) {
        got.push_back(yuvOf(rgb));
        if (!isNear(got.back(), yuv, 1))
            report.fail(std::string(name) + ", red, green and blue " +
                            text(Color{rgb.r, rgb.g, rgb.b}) + ": (y, u, v)",
                        text(got.back()), text(yuv));
    }
    const Yuv white = got[1], red = got[2], orange = got[5];
    report.guess(
        {{"full range: video has white at 235 and black at 16", [&] { return white.y == 255; }},
         {"BT.601, the weights of old televisions (0.299, 0.587, 0.114)",
          [&] { return std::abs(red.y - 81) <= 1; }},
         {"u and v exchanged: u belongs to blue, v to red",
          [&] {
              return isNear(red, {63, 240, 102}, 1);
          }},
         {"red and blue exchanged: BGR", [&] { return std::abs(red.y - 32) <= 1; }},
         {"u and v without their middle: grey has 128 in both", [&] { return white.u == 0; }},
         {"u and v not scaled: their range is 224, from 16 to 240",
          [&] { return orange.y == 141 && white.u == 128; }}});
}

/// Rows whose first byte is the row's number, counted from the top.
inline Pixels numberedRows(int width, int height, int channels, bool bottomUp) {
    Pixels pixels;
    pixels.resize(width, height, channels);
    pixels.bottomUp = bottomUp;
    const auto rowBytes = static_cast<std::size_t>(channels * width);
    for (std::size_t k = 0; k < pixels.bytes.size(); ++k) {
        const std::size_t row = k / rowBytes, last = static_cast<std::size_t>(height) - 1;
        pixels.bytes[k] = static_cast<std::uint8_t>(bottomUp ? last - row : row);
    }
    return pixels;
}

inline void rowsByHand(Report& report) {
    for (const bool bottomUp : {true, false})
        for (const int channels : {4, 3}) {
            const Pixels pixels = numberedRows(5, 4, channels, bottomUp);
            const auto [top, step] = rowsFromTop(pixels);
            const std::string which = std::string(bottomUp ? "bottom" : "top") + " row first, " +
                                      text(channels) + " bytes a pixel, 5 pixels wide: ";
            const int rightStep = (bottomUp ? -1 : 1) * 5 * channels;
            const auto place = static_cast<int>(top - pixels.bytes.data());
            const int rightPlace = bottomUp ? 3 * 5 * channels : 0;
            if (place != rightPlace)
                report.fail(which + "place of the top row of 4, in bytes", text(place),
                            text(rightPlace));
            if (step != rightStep)
                report.fail(which + "step to the next row", text(step), text(rightStep));
            report.guess({{"upside down: OpenGL's first row is the bottom one",
                           [&] { return bottomUp && place == 0 && step == -rightStep; }},
                          {"starts behind the last row: that one begins a row before the end",
                           [&] { return bottomUp && place == 4 * 5 * channels; }},
                          {"a frame from memory is upright already: look at bottomUp",
                           [&] { return !bottomUp && step < 0; }},
                          {"row padding: rows lie without gaps, whatever their length",
                           [&] { return std::abs(step) > std::abs(rightStep); }}});
        }
}

/// The same content in whatever form a frame can arrive.
inline Pixels asPixels(const Frame& frame, int channels, bool bottomUp) {
    Pixels pixels;
    pixels.resize(frame.width, frame.height, channels);
    pixels.bottomUp = bottomUp;
    std::size_t at = 0;
    for (int row = 0; row < frame.height; ++row)
        for (int x = 0; x < frame.width; ++x) {
            const Color color = colorAt(frame, x, bottomUp ? frame.height - 1 - row : row);
            const int values[] = {color.r, color.g, color.b, 255};
            for (int channel = 0; channel < channels; ++channel)
                pixels.bytes[at++] = static_cast<std::uint8_t>(values[channel]);
        }
    return pixels;
}

/// A picture whose rows are longer than they need to be, as encoders like them.
inline libav::Owned<AVFrame> paddedPicture(int width, int height) {
    libav::Owned<AVFrame> picture(av_frame_alloc());
    picture->width = width;
    picture->height = height;
    picture->format = AV_PIX_FMT_YUV420P;
    libav::check(av_frame_get_buffer(picture.get(), 64), "a picture");
    for (int plane = 0; plane < 3; ++plane)
        std::fill_n(picture->data[plane], picture->linesize[plane] * (plane ? height / 2 : height),
                    std::uint8_t{0});
    return picture;
}

inline Yuv yuvAt(const AVFrame& picture, int x, int y) {
    const auto sample = [&](int plane, int column, int row) {
        return int{picture.data[plane][row * picture.linesize[plane] + column]};
    };
    return {sample(0, x, y), sample(1, x / 2, y / 2), sample(2, x / 2, y / 2)};
}

inline void guessConversion(Report& report, const AVFrame& picture, const Frame& frame) {
    const auto matches = [&](auto expected) {
        for (const Corner& corner : corners)
            if (!isNear(yuvAt(picture, corner.x, corner.y), expected(corner.x, corner.y), 3))
                return false;
        return true;
    };
    const auto at = [&](int x, int y) { return colorAt(frame, x, y); };
    constexpr int whiteBar = barLeft + barWidth * (barBits - 1) + barWidth / 2;  // odd numbers
    report.guess(
        {{"nothing was converted",
          [&] {
              return isNear(yuvAt(picture, 60, 10), Yuv{0, 0, 0}, 0);
          }},
         {"upside down: OpenGL's first row is the bottom one",
          [&] {
              return matches([&](int x, int y) { return rightYuv(at(x, testHeight - 1 - y)); });
          }},
         {"red and blue exchanged: BGR",
          [&] {
              return matches([&](int x, int y) {
                  const Color c = at(x, y);
                  return rightYuv({c.b, c.g, c.r});
              });
          }},
         {"full range: players expect 16 to 235",
          [&] { return yuvAt(picture, whiteBar, barTop + 8).y >= 245; }},
         {"BT.601, the colours of old televisions",
          [&] {
              const Color c = at(corners[0].x, corners[0].y);
              const double y601 = 16 + (0.299 * c.r + 0.587 * c.g + 0.114 * c.b) * 219 / 255;
              return std::abs(yuvAt(picture, corners[0].x, corners[0].y).y - y601) <= 2;
          }},
         {"row padding: a row of the picture is longer than its pixels, its linesize says how long",
          [] { return true; }}});
}

/// Whether all pixels around are alike: near an edge a u and v belongs to both sides of it.
inline bool isFlatAround(const Frame& frame, int x, int y) {
    for (int row = std::max(y - 3, 0); row <= std::min(y + 4, frame.height - 1); ++row)
        for (int column = std::max(x - 3, 0); column <= std::min(x + 4, frame.width - 1); ++column)
            if (!isNear(colorAt(frame, column, row), colorAt(frame, x, y), 0)) return false;
    return true;
}

inline void picturesConvert(Report& report) {
    const Frame frame = numberedFrame(21);
    for (const int channels : {4, 3})
        for (const bool bottomUp : {true, false}) {
            FrameConverter converter(testWidth, testHeight, channels);
            const auto picture = paddedPicture(testWidth, testHeight);
            converter.convert(asPixels(frame, channels, bottomUp), *picture);
            for (int y = 0; y < testHeight; y += 2)
                for (int x = 0; x < testWidth; x += 2) {
                    const Yuv got = yuvAt(*picture, x, y), right = rightYuv(colorAt(frame, x, y));
                    if (isFlatAround(frame, x, y) && !isNear(got, right, 3))
                        report.fail("pixel (" + text(x) + ", " + text(y) + "), " + text(channels) +
                                        " bytes a pixel, " + (bottomUp ? "bottom" : "top") +
                                        " row first: (y, u, v)",
                                    text(got), text(right));
                }
            if (report.failed()) return guessConversion(report, *picture, frame);
        }
}

}  // namespace ballpit::check
