"""One equilibrium: Newton's method, minima, two meshes and the error they tell, eigenvalues, maxima."""
