import "./theme.css";
import { applyTheme } from "./state/theme.ts";
import "./app.ts";

applyTheme();
