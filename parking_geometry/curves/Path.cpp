#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        // Gauss-Legendre, five points on [-1, 1].
        constexpr double NODES[] = {-0.906179845938663993, -0.538469310105683091, 0.0, 0.538469310105683091,
                                    0.906179845938663993};
        constexpr double WEIGHTS[] = {0.236926885056189088, 0.478628670499366468, 0.568888888888888889,
                                      0.478628670499366468, 0.236926885056189088};

        /** Angle up to which the quadrature is exact to about 1e-13 of the length. */
        constexpr double ANGLE_PER_PANEL = 0.5;

        bool isArc(const PathPiece &piece)
        {
            return piece.sharpness == 0.0 && piece.turn == 0.0;
        }

        /** A place on a path: a piece and the metres driven along it. */
        struct Cut
        {
            std::size_t piece;
            double driven;
        };

        /** The place after \e driven metres, before any turns on the spot there. It snaps to the end of a piece within
            a nanometre, so that rounding leaves no tiny pieces at cusps. */
        Cut cutAt(const std::vector<PathPiece> &pieces, double driven)
        {
            constexpr double HAIR = 1e-9;  // metres
            std::size_t piece = 0;
            while (piece < pieces.size() && driven >= HAIR && pieces[piece].driven() - driven < HAIR)
                driven -= pieces[piece++].driven();
            return {piece, piece < pieces.size() && driven >= HAIR ? driven : 0.0};
        }

        Pose poseAt(const Path &path, const Cut &cut)
        {
            Pose pose = path.start;
            for (std::size_t i = 0; i < cut.piece; ++i)
                pose = advance(pose, path.pieces[i]);
            return cut.driven > 0.0 ? advance(pose, path.pieces[cut.piece], cut.driven) : pose;
        }
    }  // namespace

    PathPiece PathPiece::turnOnTheSpot(double angle)
    {
        PathPiece piece;
        piece.turn = angle;
        return piece;
    }

    PathPiece PathPiece::reversed() const
    {
        PathPiece piece(endCurvature(), -length, -sharpness);
        piece.turn = -turn;
        return piece;
    }

    Pose advance(const Pose &pose, const PathPiece &piece, double driven)
    {
        if (piece.turn != 0.0)
            return {pose.x, pose.y, pose.yaw + piece.turn};
        const double sign = piece.length < 0.0 ? -1.0 : 1.0;
        if (piece.sharpness == 0.0)
            return advance(pose, piece.curvature, sign * driven);
        const double steepest = std::max(std::abs(piece.curvature), std::abs(piece.curvatureAt(driven)));
        const int panels = 1 + static_cast<int>(steepest * driven / ANGLE_PER_PANEL);
        const double half = 0.5 * driven / panels;
        const auto yawAt = [&](double s)
        {
            return pose.yaw + sign * s * (piece.curvature + 0.5 * piece.sharpness * s);
        };
        double x = 0.0, y = 0.0;
        for (int panel = 0; panel < panels; ++panel)
            for (int i = 0; i < 5; ++i)
            {
                const double yaw = yawAt(half * (2 * panel + 1 + NODES[i]));
                x += WEIGHTS[i] * std::cos(yaw);
                y += WEIGHTS[i] * std::sin(yaw);
            }
        return {pose.x + sign * half * x, pose.y + sign * half * y, yawAt(driven)};
    }

    double Path::length() const
    {
        double sum = 0.0;
        for (const PathPiece &piece : pieces)
            sum += piece.driven();
        return sum;
    }

    std::size_t Path::cusps() const
    {
        const std::size_t count = stretches().size();
        return count > 0 ? count - 1 : 0;
    }

    Pose Path::end() const
    {
        Pose pose = start;
        for (const PathPiece &piece : pieces)
            pose = advance(pose, piece);
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }

    Path Path::reversed() const
    {
        Path result{end(), {}};
        result.pieces.reserve(pieces.size());
        for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
            result.pieces.push_back(piece->reversed());
        return result;
    }

    void Path::append(const PathPiece &piece)
    {
        if (piece.length == 0.0 && piece.turn == 0.0)
            return;
        if (!pieces.empty())
        {
            PathPiece &last = pieces.back();
            if (isArc(last) && isArc(piece) && last.curvature == piece.curvature && last.length * piece.length > 0.0)
            {
                last.length += piece.length;
                return;
            }
        }
        pieces.push_back(piece);
    }

    void Path::extend(const Path &path)
    {
        for (const PathPiece &piece : path.pieces)
            append(piece);
    }

    Path Path::part(std::size_t first, std::size_t last) const
    {
        Path result{
            start,
            {pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.begin() + static_cast<std::ptrdiff_t>(last)}};
        for (std::size_t i = 0; i < first; ++i)
            result.start = advance(result.start, pieces[i]);
        return result;
    }

    Path Path::rest(double driven) const
    {
        const Cut cut = cutAt(pieces, driven);
        Path result{poseAt(*this, cut), {}};
        for (std::size_t i = cut.piece; i < pieces.size(); ++i)
        {
            PathPiece left = pieces[i];
            if (i == cut.piece)
            {
                left.curvature = left.curvatureAt(cut.driven);
                left.length = left.direction() * (left.driven() - cut.driven);
            }
            result.append(left);
        }
        return result;
    }

    Pose Path::at(double driven) const
    {
        return poseAt(*this, cutAt(pieces, driven));
    }

    std::vector<Stretch> Path::stretches() const
    {
        std::vector<Stretch> result;
        std::size_t first = 0;  // of the turns that belong to the next driven piece
        double driven = 0.0;
        for (std::size_t i = 0; i < pieces.size(); ++i)
        {
            const int direction = pieces[i].direction();
            if (direction == 0)
                continue;
            if (result.empty() || result.back().direction != direction)
                result.push_back({first, i + 1, direction, driven});
            result.back().last = first = i + 1;
            driven += pieces[i].driven();
        }
        if (!result.empty())
            result.back().last = pieces.size();
        return result;
    }

    SampledPath Path::sample(double step) const
    {
        SampledPath path;
        PathState state;
        state.pose = start;
        // A turn before the first drive has the direction of that drive.
        const auto drives = [](const PathPiece &piece)
        {
            return piece.direction() != 0;
        };
        if (const auto first = std::find_if(pieces.begin(), pieces.end(), drives); first != pieces.end())
            state.direction = first->direction();
        for (const PathPiece &piece : pieces)
        {
            const double length = piece.driven();
            if (length == 0.0 && piece.turn == 0.0)
                continue;
            if (piece.turn == 0.0)
            {
                state.direction = piece.direction();
                state.curvature = piece.curvature;
            }
            if (path.empty())
                path.push_back(state);
            const Pose from = path.back().pose;
            const double before = path.back().arcLength;
            const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
            for (std::size_t i = 1; i <= count; ++i)
            {
                const double driven = length * static_cast<double>(i) / static_cast<double>(count);
                state.pose = advance(from, piece, driven);
                state.arcLength = before + driven;
                if (piece.turn == 0.0)
                    state.curvature = piece.curvatureAt(driven);
                path.push_back(state);
            }
        }
        if (path.empty())
            path.push_back(state);
        for (PathState &each : path)
            each.pose.yaw = wrapAngle(each.pose.yaw);
        return path;
    }

    double pathLength(const SampledPath &path)
    {
        return path.empty() ? 0.0 : path.back().arcLength - path.front().arcLength;
    }
}  // namespace parking
