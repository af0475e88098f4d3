// Embree 3 and 4 behind one spelling. Only the two query calls differ in what is used here.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace drude {

inline void embree_intersect(RTCScene scene, RTCRayHit* ray_hit) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, ray_hit, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, ray_hit);
#endif
}

inline void embree_occluded(RTCScene scene, RTCRay* ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, ray);
#endif
}

}  // namespace drude
