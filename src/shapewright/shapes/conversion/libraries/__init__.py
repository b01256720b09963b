"""The objects of each library as shapes; a module imports its library only where it is handed its objects."""
