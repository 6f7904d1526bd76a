"""`sched-sim explore`: designs drawn in a browser, by the module that also makes notebooks and reports alive."""
