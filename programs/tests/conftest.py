import pytest
from octahedron import FACES, VERTICES


@pytest.fixture
def octahedron():
    return VERTICES, FACES
