// The pages of the marker application.
import "./application.js";
import "../main.js";
