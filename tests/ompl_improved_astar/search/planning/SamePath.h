#pragma once

#include "parking_geometry/curves/Path.h"

namespace parking_test
{
    /** \brief Are these paths between the same poses the same, as far as pieces, length and cusps tell? */
    inline bool isSamePath(const parking::Path &a, const parking::Path &b)
    {
        return a.pieces.size() == b.pieces.size() && a.length() == b.length() && a.cusps() == b.cusps();
    }
}  // namespace parking_test
