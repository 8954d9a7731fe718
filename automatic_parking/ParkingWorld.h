#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/world/IndexedObstacles.h"

#include <limits>
#include <memory>

namespace parking
{
    /** \brief Minimum distance in metres between the body and the obstacles along \e path, to a millimetre or one
        percent; 0 in contact. */
    double minClearance(const FootprintChecker &checker, const Path &path);

    /** \brief Obstacles with collision checkers for a car. Cheap to copy; copies share the obstacles. */
    class ParkingWorld
    {
    public:
        /** \brief Reads the obstacles of \e scenario for its car. Throws what FootprintChecker throws.

            \param contact decides poses within rounding errors of contact (see FootprintChecker); without it they
            collide
            \param fieldReach metres; a finite value such as IndexedObstacles::LOCAL_REACH makes update() fast */
        explicit ParkingWorld(const Scenario &scenario, ContactTestMaker contact = {},
                              double fieldReach = std::numeric_limits<double>::infinity());

        /** \brief Changes cells of a grid world in place. The change applies to all copies and checkers of this world,
            which no other thread may use at the same time (see IndexedObstacles). Throws what
            IndexedObstacles::update() throws. */
        void update(const GridUpdate &update);

        /** \brief An independent copy of the current world. */
        ParkingWorld snapshot() const;

        /** \brief The checker of the car's own rectangle. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief A checker of the rectangle enlarged by \e gap metres on every side; null if it is larger than the
            world. */
        std::shared_ptr<const FootprintChecker> enlarged(double gap) const;

    private:
        ContactTestMaker contact_;
        std::shared_ptr<IndexedObstacles> obstacles_;
        std::shared_ptr<const FootprintChecker> footprint_;
    };
}  // namespace parking
