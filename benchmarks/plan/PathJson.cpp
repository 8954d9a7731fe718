#include "benchmarks/plan/PathJson.h"

#include "parking_geometry/Error.h"

using nlohmann::json;

namespace parking
{
    json toJson(const Path &path)
    {
        json pieces = json::array();
        for (const PathPiece &piece : path.pieces)
            if (piece.turn != 0.0)
                pieces.push_back(json::array({piece.turn}));
            else if (piece.sharpness == 0.0)
                pieces.push_back(json::array({piece.curvature, piece.length}));
            else
                pieces.push_back(json::array({piece.curvature, piece.length, piece.sharpness}));
        return {{"start", json::array({path.start.x, path.start.y, path.start.yaw})}, {"pieces", std::move(pieces)}};
    }

    Path pathFromJson(const json &text)
    {
        const json &start = text.at("start");
        Path path{{start.at(0).get<double>(), start.at(1).get<double>(), start.at(2).get<double>()}, {}};
        for (const json &each : text.at("pieces"))
        {
            if (!each.is_array() || each.empty() || each.size() > 3)
                throw Error("path: a piece must be an array of one to three numbers");
            const double first = each.at(0).get<double>();
            if (each.size() == 1)
                path.pieces.push_back(PathPiece::turnOnTheSpot(first));
            else
                path.pieces.emplace_back(first, each.at(1).get<double>(),
                                         each.size() == 3 ? each.at(2).get<double>() : 0.0);
        }
        return path;
    }
}  // namespace parking
