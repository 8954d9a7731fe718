#include "parking_geometry/curves/PathArcs.h"

#include <cmath>

namespace parking
{
    bool visitArcs(const Path &path, double reach, double deviation,
                   const std::function<bool(const Pose &, const PathPiece &)> &visit)
    {
        Pose start = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const double length = piece.driven();
            const double share = std::abs(piece.sharpness) * (reach / 8.0 + length / 12.0) / deviation;
            const int count = 1 + static_cast<int>(length * std::sqrt(share));
            if (piece.sharpness == 0.0 && !visit(start, piece))
                return false;
            for (int i = 0; i < count && piece.sharpness != 0.0; ++i)
            {
                const double from = length * i / count, to = length * (i + 1) / count;
                if (!visit(advance(start, piece, from), {piece.curvatureAt(0.5 * (from + to)), piece.length / count}))
                    return false;
            }
            start = advance(start, piece);
        }
        return true;
    }
}  // namespace parking
