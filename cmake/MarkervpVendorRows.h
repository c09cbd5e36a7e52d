/*
 * The rows of one driver's table: MARKERVP_ROW(n) for each of MARKERVP_COUNT devices, eight at
 * most, and an empty one, by which SDT finds the end. No guard: each table includes it once.
 */
#if MARKERVP_COUNT > 0
MARKERVP_ROW(0),
#endif
#if MARKERVP_COUNT > 1
    MARKERVP_ROW(1),
#endif
#if MARKERVP_COUNT > 2
    MARKERVP_ROW(2),
#endif
#if MARKERVP_COUNT > 3
    MARKERVP_ROW(3),
#endif
#if MARKERVP_COUNT > 4
    MARKERVP_ROW(4),
#endif
#if MARKERVP_COUNT > 5
    MARKERVP_ROW(5),
#endif
#if MARKERVP_COUNT > 6
    MARKERVP_ROW(6),
#endif
#if MARKERVP_COUNT > 7
    MARKERVP_ROW(7),
#endif
#if MARKERVP_COUNT > 8
#error "VENDOR_BSP takes eight devices of a driver at most"
#endif
{
  0
}
#undef MARKERVP_ROW
#undef MARKERVP_COUNT
