# Third-party libraries. The library itself uses header-only ones, privately: nothing of them shows in its public headers
# or in its installed package.
