// Four by four pixels for the lesson's figures: their colours, y, u and v, and their rows.
#pragma once

#include <array>

#include "09_video_recording/frame_converter.h"
#include "common/findings.h"

namespace ballpit {

/// The edge of an orange ball on blue sky, the top row first.
constexpr int blockSide = 4;
constexpr Rgb sky{150, 195, 240}, ball{210, 80, 20};
constexpr std::array<Rgb, blockSide * blockSide> block{sky, sky, sky,  sky,  sky, sky,  sky,  ball,
                                                       sky, sky, ball, ball, sky, ball, ball, ball};

/// The colour that two by two pixels share: their mean.
inline Rgb meanOf(int column, int row) {
    Rgb sum{0, 0, 0};
    for (const int k : {0, 1, blockSide, blockSide + 1}) {
        const Rgb pixel = block[static_cast<std::size_t>(row * blockSide + column + k)];
        sum = {sum.r + pixel.r, sum.g + pixel.g, sum.b + pixel.b};
    }
    return {sum.r / 4, sum.g / 4, sum.b / 4};
}

inline void addBlock(Findings& findings) {
    std::vector<double> rgb, y, u, v;
    for (const Rgb pixel : block) {
        rgb.insert(rgb.end(), {double(pixel.r), double(pixel.g), double(pixel.b)});
        y.push_back(yuvOf(pixel).y);
    }
    for (const int row : {0, 2})
        for (const int column : {0, 2}) {
            u.push_back(yuvOf(meanOf(column, row)).u);
            v.push_back(yuvOf(meanOf(column, row)).v);
        }
    Pixels pixels;
    pixels.resize(blockSide, blockSide, 4);
    const Rows rows = rowsFromTop(pixels);
    findings.list("block, rgb", rgb);
    findings.list("block, y", y);
    findings.list("block, u", u);
    findings.list("block, v", v);
    findings.list("rows, top and step",
                  std::vector<double>{double(rows.top - pixels.bytes.data()), double(rows.step)});
}

}  // namespace ballpit
