// BRUSHFIRE_INLINE: small functions of inner loops that compilers must not call.
#pragma once

#if defined(__GNUC__)
#define BRUSHFIRE_INLINE [[gnu::always_inline]] inline
#else
#define BRUSHFIRE_INLINE inline
#endif
