#include "state_validity/sweeps/SweepFront.h"

#include <algorithm>

namespace parking
{
    namespace
    {
        // Arcs of a larger radius in metres lose digits relative to their centre.
        constexpr double MAX_RADIUS = 1e4;
        constexpr double MAX_TURN = 1.01;  // radians
        // Smallest ratio of the turning circle to the box.
        constexpr double CLEAR_OF_BOX = 1.02;
        constexpr double SLACK = 1e-4;  // metres added to the bounds of the swept area, above the motion within OVERRUN
    }                                   // namespace

    bool SweepFront::applies(const BoxSweep &sweep)
    {
        if (sweep.curvature == 0.0)
            return true;
        const double curvature = std::abs(sweep.curvature);
        return curvature * MAX_RADIUS >= 1.0 && curvature * CLEAR_OF_BOX * sweep.halfWidth <= 1.0 &&
               curvature * sweep.length <= MAX_TURN && std::abs(sweep.axle) <= sweep.halfLength;
    }

    SweepFront::SweepFront(const OrientedBox &box, const BoxSweep &sweep, double middleCosine, double middleSine)
      : straight_(sweep.curvature == 0.0),
        dx_(sweep.direction * box.cosine),
        dy_(sweep.direction * box.sine)
    {
        const double axle = sweep.direction * sweep.axle, width = sweep.halfWidth;
        if (straight_)
        {
            turning_ = 1.0;
            limit_ = sweep.length + OVERRUN;
            radius_ = 0.0;
            cx_ = box.x;
            cy_ = box.y;
            lx_ = -dy_;
            ly_ = dx_;
            front_ = back_ = sweep.halfLength;
            inner_ = outer_ = width;
            mx_ = box.x;
            my_ = box.y;
            mdx_ = dx_;
            mdy_ = dy_;
            low_ = -back_ - SLACK;
            high_ = front_ + sweep.length + SLACK;
            left_ = width + SLACK;
            right_ = -left_;
            return;
        }
        turning_ = sweep.curvature * sweep.direction > 0.0 ? 1.0 : -1.0;
        radius_ = 1.0 / std::abs(sweep.curvature);
        lx_ = -turning_ * dy_;
        ly_ = turning_ * dx_;
        front_ = sweep.halfLength - axle;
        back_ = sweep.halfLength + axle;
        inner_ = radius_ - width;
        outer_ = radius_ + width;
        innerSquare_ = inner_ * inner_;
        outerSquare_ = outer_ * outer_;
        cx_ = box.x + axle * dx_ + radius_ * lx_;
        cy_ = box.y + axle * dy_ + radius_ * ly_;
        const auto corner = [this](double along, double out)
        {
            return Corner{along * dx_ - out * lx_, along * dy_ - out * ly_, along * along + out * out};
        };
        frontInner_ = corner(front_, inner_);
        frontOuter_ = corner(front_, outer_);
        rearOuter_ = corner(-back_, outer_);
        nearest_ = innerSquare_;
        farthest_ = std::max(frontOuter_.square, rearOuter_.square);
        limit_ = 2.0 * middleSine * middleCosine + OVERRUN / radius_;

        // The frame half way, with the centre of the arc as origin. The sines of the angles determine the bounding box
        // of the swept area.
        mx_ = cx_;
        my_ = cy_;
        mdx_ = middleCosine * dx_ + middleSine * lx_;
        mdy_ = middleCosine * dy_ + middleSine * ly_;
        const double reach = std::max(front_, back_) * middleSine + SLACK;
        high_ = front_ + outer_ * middleSine + SLACK;
        low_ = -back_ - outer_ * middleSine - SLACK;
        const double near = -inner_ * middleCosine + reach, far = -outer_ - reach;
        // The direction towards the centre is left for a motion that turns left.
        left_ = turning_ > 0.0 ? near : -far;
        right_ = turning_ > 0.0 ? far : -near;
    }
}  // namespace parking
