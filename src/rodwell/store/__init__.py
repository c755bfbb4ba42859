"""Files: NetCDF, folders written whole or not at all."""
