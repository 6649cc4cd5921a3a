"""A cortex in FreeSurfer's and GIFTI's files."""

from files.cortex import write_cortex

write_cortex()
