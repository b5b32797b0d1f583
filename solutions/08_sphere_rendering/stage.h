// The stage on which balls are shown: background, floor with shade, the box's edges, axes.
#pragma once

#include "08_sphere_rendering/ball_shapes.h"

namespace ballpit {

class Stage {
public:
    explicit Stage(Bounds world);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Paints the shade of the balls on the floor, to be called before the frame is bound.
    void shade(const BallQuads& quads);
    void shade(const BallPoints& points);
    void forgetShade();

    /// What lies behind the balls.
    void drawBackground() const;
    void drawFloor(bool grid) const;
    /// Lines, to be drawn last: their soft borders blend with what is behind them.
    void drawLines() const;

private:
    template <class Draw>
    void paintShade(const OpenGLProgram& program, Draw drawSquares);
    void bindTexture() const;

    Bounds world_;
    OpenGLProgram floorProgram_, quadShade_, pointShade_;
    GLuint texture_ = 0, framebuffer_ = 0;
    int texelsX_ = 0, texelsZ_ = 0;
};

}  // namespace ballpit
